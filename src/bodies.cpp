// SPDX-License-Identifier: Apache-2.0

#include "src/bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "src/arrival_time.h"
#include "src/disc.h"
#include "src/finite_shift.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Chords, between planes' foot points, are every other segment of a path whose finite distances count.
constexpr bool is_chord(std::size_t segment) {
  return segment % 2 == 1;
}

/// A chord joins its neighbours.
template <class Number>
RaySegment<Number> shifted_chord(const Deflectors& finite, const RayPath<Number>& path, std::size_t i) {
  return chord_between(finite, path.segments[i - 1], path.segments[i + 1]);
}

/// Where a path meets a body.
template <class Number>
struct Meeting {
  std::size_t segment;
  StretchHit<Number> at;
};

template <class Number>
std::optional<Meeting<Number>> find_meeting(const Sphere& sphere, const RayPath<Number>& path,
                                            const Deflectors* finite) {
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    RaySegment<Number> stretch = path.segments[i];
    if (finite) {
      stretch = is_chord(i) ? shifted_chord(*finite, path, i) : shifted_to_ball(*finite, stretch, sphere);
    }
    const Number entry = sphere_entry(stretch.start, stretch.direction, sphere.centre, sphere.radius);
    if (!(value_of(entry) <= value_of(stretch.length)) || !(value_of(entry) < kInfinity)) continue;
    const Vector<Number> point = stretch.start + stretch.direction * entry;
    return Meeting<Number>{i, {point, value_of(stretch.direction), value_of(entry)}};
  }
  return std::nullopt;
}

template <class Number>
std::optional<Meeting<Number>> find_meeting(const Disc& disc, const RayPath<Number>& path,
                                            const Deflectors* finite) {
  DiscPassage passage;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const bool chord = finite && is_chord(i);
    const auto crossing = meet_disc(disc, chord ? shifted_chord(*finite, path, i) : path.segments[i],
                                    chord ? nullptr : finite, passage);
    if (crossing) return Meeting<Number>{i, *crossing};
  }
  return std::nullopt;
}

template <class Number>
std::optional<Meeting<Number>> find_meeting(const Surface& surface, const RayPath<Number>& path,
                                            const Deflectors* finite) {
  if (const auto* sphere = std::get_if<Sphere>(&surface)) return find_meeting(*sphere, path, finite);
  return find_meeting(*disc_of(surface), path, finite);
}

/// Shapiro delay of the masses that the light from a point `travelled` metres along the path, on its segment
/// number `i`, does not pass.
template <class Number>
double delay_by_masses_ahead(const Deflectors& deflectors, const RayPath<Number>& path, std::size_t i,
                             double travelled) {
  const Vec3 start = value_of(path.segments[i].start), direction = value_of(path.segments[i].direction);
  double delay = 0.0;
  for (const DeflectorPlane& plane : deflectors.planes) {
    for (const Deflector& deflector : plane.deflectors) {
      const bool passed = std::any_of(path.passages.begin(), path.passages.end(), [&](const auto& p) {
        return p.lens == deflector.lens && value_of(p.path) <= travelled;
      });
      if (passed) continue;
      const Vec3 to_mass = deflector.position - start;
      const double along = to_mass.dot(direction);
      const double z1 = value_of(path.lengths[i]) + along;
      delay += 2.0 * deflector.m *
               shapiro_logarithm_between(z1, travelled - z1, length(to_mass - direction * along));
    }
  }
  return delay;
}

template <class Number>
SurfaceHit<Number> meet_sphere_at(const Sphere& sphere, const Vector<Number>& point) {
  SurfaceHit<Number> hit;
  hit.outcome = Outcome::Hit;
  hit.st = st_from_sphere_normal(local_from_parent(sphere.axes, point - constant<Number>(sphere.centre)));
  return hit;
}

template <class Number>
SurfaceHit<Number> meet_ring_at(const Ring& ring, const Vector<Number>& point) {
  SurfaceHit<Number> hit;
  hit.outcome = Outcome::Hit;
  hit.st = st_from_ring_point(ring, local_from_parent(ring.axes, point - constant<Number>(ring.centre)));
  return hit;
}

template <class Number>
SurfaceHit<Number> meet_card_at(const Camera& camera, FilmPosition film, const Vector<Number>& first,
                                const Vector<Number>& point) {
  SurfaceHit<Number> hit = meet_plate(camera, film, first, point * reciprocal(length(point)));
  if (hit.outcome != Outcome::Hit) return {};
  hit.magnification = 0;  // the plate's at infinity
  return hit;
}

}  // namespace

bool is_body(const Surface& surface) {
  return !std::holds_alternative<Plate>(surface) && !std::holds_alternative<LatLong>(surface);
}

template <class Number>
Number sphere_entry(const Vector<Number>& start, const Vector<Number>& direction, const Vec3& centre,
                    double radius) {
  const Vector<Number> to_centre = constant<Number>(centre) - start;
  const Number along = to_centre.dot(direction);
  const Vector<Number> across = to_centre - direction * along;
  const Number half_chord2 = Number(radius * radius) - across.dot(across);
  if (!(value_of(half_chord2) >= 0.0)) return kInfinity;
  const Number near = along - sqrt(half_chord2);
  return value_of(near) >= -kSurfaceTolerance * radius ? near : Number(kInfinity);
}

template <class Number>
RaySegment<Number> shifted_to_ball(const Deflectors& deflectors, const RaySegment<Number>& stretch,
                                   const Sphere& sphere) {
  return shifted(deflectors, stretch,
                 way_to_ball(sphere, stretch.start, stretch.direction, value_of(stretch.length)));
}

template <class Number>
SurfaceHit<Number> meet_body_at(const Surface& surface, const Camera& camera, FilmPosition film,
                                const Vector<Number>& first, const Vector<Number>& point) {
  if (const auto* sphere = std::get_if<Sphere>(&surface)) return meet_sphere_at(*sphere, point);
  if (const auto* ring = std::get_if<Ring>(&surface)) return meet_ring_at(*ring, point);
  return meet_card_at(camera, film, first, point);
}

double magnification_on_body(const Surface& surface, const DualVec3& first, const DualVec3& point) {
  const auto* sphere = std::get_if<Sphere>(&surface);
  const Vec3 seen_from = value_of(point);
  return magnification_of_point(first, point, sphere ? seen_from - sphere->centre : -seen_from);
}

template <class Number>
SurfaceHit<Number> meet_body(const Surface& surface, const Camera& camera, FilmPosition film,
                             const RayPath<Number>& path, const Deflectors* finite) {
  const auto meeting = find_meeting(surface, path, finite);
  SurfaceHit<Number> hit;
  if (!meeting) {
    hit.outcome = path.captured ? Outcome::Captured : path.unresolved ? Outcome::Unresolved : Outcome::Missed;
    hit.direction = value_of(path.segments.back().direction);
    hit.bends = path.bends;
    return hit;
  }
  const auto& [segment, at] = *meeting;
  const Vector<Number>& first = path.segments.front().direction;
  hit = meet_body_at(surface, camera, film, first, at.point);
  hit.direction = at.direction;
  hit.bends = path.segments[segment].bends;
  if (hit.outcome != Outcome::Hit) return hit;
  if constexpr (std::is_same_v<Number, Dual>)
    hit.magnification = magnification_on_body(surface, first, at.point);
  hit.distance = value_of(path.lengths[segment]) + at.way;
  Vec3 aside(0);  // the light runs beside its stretch
  if (finite && !is_chord(segment))
    aside = value_of(finite_shift(*finite, path.segments[segment], Number(at.way)));
  hit.delay = excess_over_straight_line(excess_until(path, segment), at.way, aside) +
              shapiro_delay(path, hit.distance);
  if (finite) hit.delay += delay_by_masses_ahead(*finite, path, segment, hit.distance);
  return hit;
}

template double sphere_entry(const Vec3&, const Vec3&, const Vec3&, double);
template Dual sphere_entry(const DualVec3&, const DualVec3&, const Vec3&, double);
template RaySegment<double> shifted_to_ball(const Deflectors&, const RaySegment<double>&, const Sphere&);
template RaySegment<Dual> shifted_to_ball(const Deflectors&, const RaySegment<Dual>&, const Sphere&);
template SurfaceHit<double> meet_body_at(const Surface&, const Camera&, FilmPosition, const Vec3&,
                                         const Vec3&);
template SurfaceHit<Dual> meet_body_at(const Surface&, const Camera&, FilmPosition, const DualVec3&,
                                       const DualVec3&);
template SurfaceHit<double> meet_body(const Surface&, const Camera&, FilmPosition, const RayPath<double>&,
                                      const Deflectors*);
template SurfaceHit<Dual> meet_body(const Surface&, const Camera&, FilmPosition, const RayPath<Dual>&,
                                    const Deflectors*);

}  // namespace lensplane
