// SPDX-License-Identifier: Apache-2.0

#include "src/passing_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/bodies.h"
#include "src/finite_shift.h"
#include "src/geodesic_batch.h"
#include "src/single_ray.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Curved light is taken for straight between two planes, this share of a ring's size or of a sphere's before
/// and behind it.
constexpr double kRingSlab = 1e-3, kSphereSlab = 1.0;

/// By which of a curved ray's crossings of a plane its way past a body is told.
constexpr int kCrossings = 2;

/// Are bodies met by curved rays?
bool meets_bodies_by_curve(const Plan& plan, const Camera& camera, FilmPosition film) {
  return plan.method == Method::Geodesic || curves_at(plan, camera, film);
}

/// All that bend light.
std::vector<PointMass> masses_of(const Plan& plan) {
  std::vector<PointMass> masses;
  if (plan.method == Method::Planes) {
    for (const DeflectorPlane& plane : plan.recipes.back().planes) {
      for (const Deflector& deflector : plane.deflectors) masses.push_back({deflector.m, deflector.position});
    }
    return masses;
  }
  for (const LensPlane& plane : plan.planes) {
    for (const Source& source : plane.sources) {
      if (source.m > 0.0) masses.push_back({source.m, source.position});
    }
  }
  return masses;
}

/// The planes before and behind a body between which curved light is straight; none for other surfaces. A
/// small ring far from the masses is seen edge-on as well as from above between planes that face the camera.
struct Slab {
  Vec3 centre, normal;
  double half;  // metres
  int first;    // number of the crossing
};

std::optional<Slab> slab_of(const Surface& surface, std::span<const PointMass> masses) {
  if (const auto* sphere = std::get_if<Sphere>(&surface)) {
    const double distance = length(sphere->centre);
    if (!(distance > 2.0 * sphere->radius)) return std::nullopt;
    return Slab{sphere->centre, -sphere->centre / distance, kSphereSlab * sphere->radius, 0};
  }
  const auto* ring = std::get_if<Ring>(&surface);
  if (!ring) return std::nullopt;
  const double distance = length(ring->centre);
  const bool alone = std::ranges::none_of(masses, [&](const PointMass& mass) {
    return length(mass.position - ring->centre) < 5.0 * ring->outer;
  });
  if (alone && distance > 10.0 * ring->outer)
    return Slab{ring->centre, -ring->centre / distance, ring->outer, 0};
  const Disc disc = *disc_of(surface);
  return Slab{disc.centre, disc.normal, kRingSlab * disc.outer, disc.crossing};
}

void add_discs(const Slab& slab, std::vector<Disc>& discs) {
  const double size = kCardSize * (length(slab.centre) + slab.half);
  for (int n = 0; n < kCrossings; ++n) {
    for (const double side : {1.0, -1.0}) {
      discs.push_back({slab.centre + slab.normal * (side * slab.half), slab.normal, 0.0, size, slab.first + n,
                       kDiscTolerance * slab.half});
    }
  }
}

LightLine line_of(const RaySegment<Dual>& stretch) {
  return {stretch.start, stretch.direction};
}

/// Points of a ring, one of which is about as near to a line as any: the nearest in its plane to where the
/// line goes through it, which is right for rings seen from above; and the one nearest in the direction in
/// which the ring is foreshortened, which is right for rings seen edge-on.
std::array<Vec3, 2> near_points(const Ring& ring, const Vec3& start, const Vec3& direction) {
  const Vec3& normal = ring.axes.y;
  const double tilt = normal.dot(direction), height = normal.dot(start - ring.centre);
  const Vec3 sideways = direction.cross(normal);
  const double size = length(sideways);
  const Vec3 across = size > 0.0 ? sideways / size : ring.axes.x, deep = normal.cross(across);
  // No farther than the line is where it is nearest to the centre, and ten times the ring's size.
  const double to_centre = (ring.centre - start).dot(direction),
               most = std::abs(to_centre) + 10.0 * ring.outer;
  const double way = std::abs(height) < most * std::abs(tilt) ? -height / tilt
                     : height * tilt < 0.0                    ? most
                                                              : -most;
  const Vec3 crossing = start + direction * way - ring.centre;
  const double x = std::clamp(crossing.dot(across), -ring.outer, ring.outer), y = crossing.dot(deep);
  const double inner = std::sqrt(std::max(0.0, ring.inner * ring.inner - x * x)),
               outer = std::sqrt(ring.outer * ring.outer - x * x);
  return {nearest_on_ring(ring, ring.centre + crossing),
          ring.centre + across * x + deep * std::copysign(std::clamp(std::abs(y), inner, outer), y)};
}

/// How far from a body a line passes.
double gap_of(const Surface& body, const LightLine& line) {
  const Vec3 start = value_of(line.start), direction = value_of(line.direction);
  const NearestPoint nearest = nearest_point(body, start, direction, kInfinity);
  return length(start + direction * nearest.way - nearest.of_body);
}

/// Stretch number `i` of a path as the light truly runs where it is nearest to the body.
RaySegment<Dual> true_stretch(const RayPath<Dual>& path, std::size_t i, const Deflectors* finite,
                              const Surface& body) {
  const RaySegment<Dual>& stretch = path.segments[i];
  if (!finite) return stretch;
  if (i % 2 == 1) return chord_between(*finite, path.segments[i - 1], path.segments[i + 1]);
  const NearestPoint nearest =
      nearest_point(body, value_of(stretch.start), value_of(stretch.direction), value_of(stretch.length));
  const Dual along = (constant<Dual>(nearest.of_body) - stretch.start).dot(stretch.direction);
  const bool within = nearest.way > 0.0 && nearest.way < value_of(stretch.length);
  return shifted(*finite, stretch, within ? along : Dual(nearest.way));
}

/// The line on which a path is nearest to a body.
std::optional<LightLine> line_past(const RayPath<Dual>& path, const Deflectors* finite,
                                   const Surface& surface) {
  std::optional<LightLine> best;
  double least = kInfinity;
  for (std::size_t n = 0; n < path.segments.size(); ++n) {
    const RaySegment<Dual> stretch = true_stretch(path, n, finite, surface);
    const double longest = value_of(stretch.length);
    if (!(longest > 0.0)) continue;
    const Vec3 start = value_of(stretch.start), direction = value_of(stretch.direction);
    const NearestPoint nearest = nearest_point(surface, start, direction, longest);
    const double gap = length(start + direction * nearest.way - nearest.of_body);
    if (!(gap < least)) continue;
    least = gap;
    best = line_of(stretch);
  }
  return best;
}

}  // namespace

Vec3 nearest_on_ring(const Ring& ring, const Vec3& point) {
  const Vec3 q = point - ring.centre;
  const Vec3 flat = q - ring.axes.y * q.dot(ring.axes.y);
  const double radius = length(flat);
  const Vec3 out = radius > 0.0 ? flat / radius : ring.axes.z;
  return ring.centre + out * std::clamp(radius, ring.inner, ring.outer);
}

NearestPoint nearest_point(const Surface& body, const Vec3& start, const Vec3& direction, double length) {
  const auto way_to = [&](const Vec3& point) {
    return std::clamp((point - start).dot(direction), 0.0, length);
  };
  if (const auto* sphere = std::get_if<Sphere>(&body)) return {sphere->centre, way_to(sphere->centre)};
  const Ring& ring = std::get<Ring>(body);
  NearestPoint nearest{ring.centre, way_to(ring.centre)};
  double least = kInfinity;
  for (const Vec3& point : near_points(ring, start, direction)) {
    const double way = way_to(point), gap = lensplane::length(start + direction * way - point);
    if (!(gap < least)) continue;
    least = gap;
    nearest = {point, way};
  }
  return nearest;
}

PassingLight::PassingLight(const Tracer& tracer, std::span<const FilmPosition> films)
    : tracer_(tracer), masses_(masses_of(tracer.plan())) {
  const Plan& plan = tracer.plan();
  const Camera& camera = tracer.camera();
  std::vector<FilmPosition> curved;
  for (const FilmPosition film : films) {
    first_.push_back(direction_from_film<double>(camera, film));
    if (meets_bodies_by_curve(plan, camera, film)) {
      ways_.push_back({true, curved.size()});
      curved.push_back(film);
      continue;
    }
    const std::size_t recipe = plan.method == Method::Planes ? level_at(plan, camera, film) : 0;
    const bool finite = plan.method == Method::Planes && plan.recipes[recipe].finite_distance;
    ways_.push_back({false, paths_.size()});
    paths_.push_back(path_of_ray<Dual>(camera, plan, recipe, film));
    finite_.push_back(finite ? &plan.recipes[recipe] : nullptr);
  }
  if (!curved.empty()) trace_curved(curved);
}

void PassingLight::trace_curved(std::span<const FilmPosition> films) {
  std::vector<Disc> discs;
  for (const Surface& surface : tracer_.surfaces()) {
    first_disc_.push_back(discs.size());
    if (const auto slab = slab_of(surface, masses_)) add_discs(*slab, discs);
  }
  first_disc_.push_back(discs.size());
  std::vector<DualVec3> first;
  for (const FilmPosition film : films) first.push_back(direction_from_film<Dual>(tracer_.camera(), film));
  curved_ = trace_geodesics<Dual>(masses_, constant<Dual>(Vec3(0)), first, tracer_.plan().geodesic_tolerance,
                                  {{}, discs});
}

std::optional<LightLine> PassingLight::past(std::size_t i, std::size_t k) const {
  const Surface& surface = tracer_.surfaces()[k];
  if (!std::holds_alternative<Sphere>(surface) && !std::holds_alternative<Ring>(surface)) return std::nullopt;
  const Way& way = ways_[i];
  return way.curved ? past_on_curve(curved_[way.number], k)
                    : line_past(paths_[way.number], finite_[way.number], surface);
}

std::optional<LightLine> PassingLight::past_on_curve(const GeodesicRay<Dual>& ray, std::size_t k) const {
  std::optional<LightLine> best;
  double least = kInfinity;
  for (std::size_t n = first_disc_[k]; n + 1 < first_disc_[k + 1]; n += 2) {
    const BodyHit<Dual>&before = ray.disc_hits[n], &behind = ray.disc_hits[n + 1];
    if (!before.hit || !behind.hit) continue;
    const bool forward = value_of(before.length) < value_of(behind.length);
    const DualVec3 &from = forward ? before.point : behind.point, &to = forward ? behind.point : before.point;
    const DualVec3 way = to - from;
    const DualVec3 direction = way * reciprocal(length(way));
    // From as far back as the camera is: the body may be nearest before the slab.
    const LightLine line{from - direction * Dual(length(value_of(from))), direction};
    const double gap = gap_of(tracer_.surfaces()[k], line);
    if (!(gap < least)) continue;
    least = gap;
    best = line;
  }
  return best;
}

double PassingLight::clear_of_masses(std::size_t i, double least) const {
  double clear = kInfinity;
  if (!ways_[i].curved) {
    for (const Passage<Dual>& passage : paths_[ways_[i].number].passages) {
      if (std::abs(value_of(passage.alpha)) > least)
        clear = std::min(clear, value_of(passage.b) / passage.distance);
    }
    return clear;
  }
  for (const PointMass& mass : masses_) {
    const double distance = length(mass.position), angle = angle_between(first_[i], mass.position / distance);
    if (4.0 * mass.m > least * angle * distance) clear = std::min(clear, angle);
  }
  return clear;
}

double PassingLight::deep_in_field(std::size_t i) const {
  double deep = -kInfinity;
  for (const PointMass& mass : masses_) {
    const double distance = length(mass.position);
    if (!(distance > 0.0)) return kInfinity;
    deep =
        std::max(deep, kStrongField * mass.m / distance - angle_between(first_[i], mass.position / distance));
  }
  return deep;
}

bool PassingLight::is_captured(std::size_t i) const {
  const Way& way = ways_[i];
  return way.curved ? curved_[way.number].captured : paths_[way.number].captured;
}

}  // namespace lensplane
