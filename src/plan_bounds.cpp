// SPDX-License-Identifier: Apache-2.0

#include "src/plan_bounds.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/bodies.h"
#include "src/bundle_way.h"
#include "src/chord_bounds.h"
#include "src/constants.h"
#include "src/disc.h"
#include "src/planes_march.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A direction and how far, in radians, others are from it at most.
struct Bundle {
  Vec3 direction;
  double spread;
};

/// A rectangle of the film, in pixels.
struct FilmTile {
  double left, top, width, height;
};

FilmTile film_tile(const Camera& camera, const TileLevels& tiles, int index) {
  const int left = index % tiles.columns * tiles.size;
  const int top = index / tiles.columns * tiles.size;
  return {static_cast<double>(left - camera.overscan), static_cast<double>(top - camera.overscan),
          static_cast<double>(std::min(tiles.size, camera.full_width() - left)),
          static_cast<double>(std::min(tiles.size, camera.full_height() - top))};
}

/// The bundle of a tile. Between its corners and the middles of its edges the film may bulge: a tenth more.
Bundle bundle_of(const Camera& camera, const FilmTile& tile) {
  const auto direction = [&](double x, double y) {
    return direction_from_film<double>(camera, {tile.left + x * tile.width, tile.top + y * tile.height});
  };
  Bundle bundle{direction(0.5, 0.5), 0.0};
  for (const double x : {0.0, 0.5, 1.0}) {
    for (const double y : {0.0, 0.5, 1.0}) {
      bundle.spread = std::max(bundle.spread, 1.1 * angle_between(bundle.direction, direction(x, y)));
    }
  }
  return bundle;
}

/// One mass as a bundle passes it.
struct Pass {
  const Deflector* deflector;
  double least_b, most_b;
  double growth;      // of the bend per metre across, at most
  bool may_lie_back;  // some rays may leave the camera at more than a right angle from it
};

/// One plane as a bundle passes it.
struct PassedPlane {
  double way;              // from the last plane, and to its farthest foot point
  double growth;           // sum over its masses
  std::size_t begin, end;  // its masses among the passes
};

struct Passes {
  bool wild = false;
  std::vector<Pass> masses;
  std::vector<PassedPlane> planes;
  Vec3 last{0};
  double last_spread = 0;
};

/// Follows a bundle past the masses; wild as soon as nothing is known any more.
Passes pass_all(const Deflectors& everything, const Bundle& bundle, double unseen_angle,
                std::vector<LensBound>& lenses) {
  Passes result;
  const RayPath<double> path = march_planes(everything, bundle.direction);
  result.wild = path.captured || path.bends != static_cast<int>(everything.outward);
  double across = 0.0;  // spread of the rays' feet, metres
  double spread = bundle.spread;
  std::size_t passage = 0;
  // Captured light may have ended on a stretch before those planes whose masses it passed.
  const auto has_stretch = [&](std::size_t k) { return 2 * k < path.segments.size(); };
  for (std::size_t k = 0; k < everything.outward && passage < path.passages.size() && has_stretch(k); ++k) {
    const DeflectorPlane& plane = everything.planes[k];
    const RaySegment<double>& segment = path.segments[2 * k];  // each plane adds two
    const double ahead = (plane.centre - segment.start).dot(segment.direction);
    PassedPlane passed{std::abs(ahead), 0.0, result.masses.size(), 0};
    double more_spread = 0.0;
    for (const Deflector& deflector : plane.deflectors) {
      if (passage == path.passages.size()) {
        lenses[deflector.lens].wild = true;  // this plane's masses have captured the ray
        continue;
      }
      const double b = path.passages[passage++].b;
      const double along = std::abs((deflector.position - segment.start).dot(segment.direction));
      passed.way = std::max(passed.way, along);
      const double aside = across + along * spread * (1.0 + spread);
      const double unseen = unseen_angle * length(deflector.position);
      const double least = std::max(b - aside, unseen);
      if (deflector.index * least < kWildRatio * kCriticalRatio * deflector.m || !(spread < 0.5)) {
        lenses[deflector.lens].wild = true;
        result.wild = true;
        continue;
      }
      const Deflection most = exact_law(deflector.m, least);
      const double growth = growth_at(deflector.m, least);
      more_spread += std::min(growth * aside, 2.0 * most.alpha);
      passed.growth += growth;
      lenses[deflector.lens].wild = lenses[deflector.lens].wild || growth * along > kWildGrowth;
      const double off = angle_between(segment.direction, deflector.position / length(deflector.position));
      result.masses.push_back({&deflector, least, b + aside, growth, off + spread > kPi / 2.0});
    }
    passed.end = result.masses.size();
    result.wild = result.wild || passed.growth * passed.way > kWildGrowth;
    result.planes.push_back(passed);
    if (result.wild) continue;
    across += passed.way * spread * (1.0 + spread);
    spread += more_spread;
  }
  if (path.captured && result.planes.size() < everything.outward) {
    for (const Deflector& deflector : everything.planes[result.planes.size()].deflectors)
      lenses[deflector.lens].wild = true;
  }
  if (!path.captured) result.last = path.segments.back().direction;
  result.last_spread = spread;
  return result;
}

/// How errors at one place grow to the end of the ray: radians there per radian, and per metre.
struct Growth {
  double per_angle = 1.0;
  double per_metre = 0.0;

  Growth before(const PassedPlane& plane) const {
    return {per_angle * (1.0 + plane.growth * plane.way) + per_metre * plane.way,
            per_angle * plane.growth + per_metre};
  }
};

/// What the finite distance of the camera changes: the bend, and where the ray goes on.
struct FiniteBound {
  double angle, shift;
};
FiniteBound finite_bound(const Pass& pass) {
  const double m = pass.deflector->m;
  const double n = pass.deflector->index;
  const double r = length(pass.deflector->position);
  const double b = std::min(pass.most_b, r);
  const double cosine = std::sqrt(std::max(0.0, 1.0 - (b / r) * (b / r)));
  const double h = 0.25 * (1.0 + cosine) * (1.0 + cosine) * (2.0 - cosine);
  const double excess = exact_law(m, pass.least_b).alpha - 4.0 * m / pass.least_b;
  // (2 m/b)(1 - cos R) = 2 m b/(r^2 (1 + cos R)); a mass in front of the screen, but not ahead of the ray,
  // bends it in full without finite distance, hardly with it.
  const bool in_full = pass.may_lie_back && pass.deflector->position.z < 0.0;
  const double weak = in_full ? 4.0 * m / pass.least_b : 2.0 * m * b / (r * r);
  return {weak + excess * (in_full ? 1.0 : 1.0 - h) + (n - 1.0) * b * pass.growth, (n - 1.0) * b};
}

/// What the finite distance of bodies changes, as an angle at the camera. Beside a mass that is in the plane
/// of a disc it is 2 m; inside a ball there is no limit.
double body_bound(const std::vector<Surface>& bodies, const Pass& pass) {
  double most = 0.0;
  for (const Surface& body : bodies) {
    const double to_mass = gap_to_body(body, pass.deflector->position);
    const double to_camera = gap_to_body(body, Vec3(0));
    const bool inside = std::holds_alternative<Sphere>(body) && !(to_mass > 0.0);
    if (inside || !(to_camera > 0.0)) return kInfinity;
    const double share = to_mass > pass.most_b ? pass.most_b / to_mass : 1.0;
    most = std::max(most, 2.0 * pass.deflector->m * share / to_camera);
  }
  return most;
}

/// Radians on the sky to pixels of the film: on a flat plate more towards its edges. Infinite where the
/// bundle may leave the plate's half of the sky.
double pixels_per_radian(const Camera& camera, bool plates, const Passes& passes) {
  const double middle = 1.0 / pixel_angle(camera);
  if (!plates || camera.projection != Projection::Perspective) return middle;
  const double off_axis = angle_between(passes.last, Vec3(0, 0, -1)) + passes.last_spread;
  const double cosine = off_axis < 1.55 ? std::cos(off_axis) : 0.0;
  return cosine > 0.0 ? middle / (cosine * cosine) : kInfinity;
}

/// The surfaces of the scene, and what of them matters here.
struct Stage {
  const Camera& camera;
  std::vector<Surface> bodies;  // camera axes
  bool plates = false;          // any picture on a plane that faces the camera
  double per_metre = 0.0;       // of an error across the ray at its end: 1/distance of the nearest body
};

Stage stage_of(const Scene& scene) {
  Stage stage{scene.camera, {}};
  for (const Surface& surface : scene.surfaces) {
    stage.plates =
        stage.plates || std::holds_alternative<Plate>(surface) || std::holds_alternative<Card>(surface);
    if (!is_body(surface)) continue;
    stage.bodies.push_back(camera_from_world(scene.camera, surface));
    const double distance = gap_to_body(stage.bodies.back(), Vec3(0));
    stage.per_metre = std::max(stage.per_metre, distance > 0.0 ? 1.0 / distance : kInfinity);
  }
  return stage;
}

void raise(double& most, double value) {
  most = std::max(most, value);
}

/// What chords misplace, in pixels: of cards, as of plates, more towards the edges of a wide frame.
double chords_bound(const Stage& stage, const Deflectors& everything, const Bundle& bundle,
                    double unseen_angle) {
  if (stage.bodies.empty() || everything.planes.empty() || everything.blind) return 0.0;
  const BundleWay way = follow_bundle(everything, bundle.direction, bundle.spread, unseen_angle);
  const double middle = 1.0 / pixel_angle(stage.camera);
  const bool flat = stage.camera.projection == Projection::Perspective;
  double most = 0.0;
  for (const Surface& body : stage.bodies) {
    if (!may_meet(way, body)) continue;
    const bool stretched = flat && std::holds_alternative<Card>(body);
    const double cosine = stretched ? -bundle.direction.z : 1.0;
    most = std::max(most, middle / (cosine * cosine) * misplaced_by_chords(way, body));
  }
  return most;
}

TileBound bound_tile(const Stage& stage, const Deflectors& everything, const Bundle& bundle,
                     std::vector<LensBound>& lenses) {
  const double unseen = kUnseenPixels * pixel_angle(stage.camera);
  const Passes passes = pass_all(everything, bundle, unseen, lenses);
  const double px = pixels_per_radian(stage.camera, stage.plates, passes);
  TileBound tile;
  tile.chords_px = chords_bound(stage, everything, bundle, unseen);
  tile.wild = passes.wild || !(px < kInfinity);
  if (tile.wild) return tile;
  Growth growth{1.0, stage.per_metre};
  for (auto plane = passes.planes.rbegin(); plane != passes.planes.rend(); ++plane) {
    for (std::size_t i = plane->begin; i < plane->end; ++i) {
      const Pass& pass = passes.masses[i];
      const double m = pass.deflector->m;
      LensBound& lens = lenses[pass.deflector->lens];
      // A bend that is off by an angle also displaces the ray by at most b times it.
      const double grown = px * (growth.per_angle + growth.per_metre * pass.most_b);
      const Company& company = pass.deflector->company;
      const double alpha = exact_law(m, pass.least_b).alpha;
      const double gain = grown * alpha * gain_in(company, pass.least_b * pass.least_b);
      const double weak = grown * weak_law_error(m, pass.least_b) + gain;
      const double second_order = grown * second_order_law_error(m, pass.least_b) + gain;
      const FiniteBound finite = finite_bound(pass);
      tile.weak_px += weak;
      tile.second_order_px += second_order;
      tile.gain_px += gain;
      tile.joint_px += kCompanyError * grown * company_bend(m, company, pass.least_b);
      raise(lens.moves_px, grown * alpha);
      raise(lens.weak_px, weak);
      raise(lens.second_order_px, second_order);
      raise(lens.gain_px, gain);
      raise(lens.finite_px, px * (growth.per_angle * finite.angle + growth.per_metre * finite.shift +
                                  body_bound(stage.bodies, pass)));
    }
    growth = growth.before(*plane);
  }
  return tile;
}

void merge(const std::vector<LensBound>& from, std::vector<LensBound>& into) {
  for (std::size_t i = 0; i < into.size(); ++i) {
    raise(into[i].moves_px, from[i].moves_px);
    raise(into[i].weak_px, from[i].weak_px);
    raise(into[i].second_order_px, from[i].second_order_px);
    raise(into[i].gain_px, from[i].gain_px);
    raise(into[i].finite_px, from[i].finite_px);
    into[i].wild = into[i].wild || from[i].wild;
  }
}

}  // namespace

FilmBounds bounds_of(const Scene& scene, const Deflectors& everything, const TileLevels& tiles) {
  const Stage stage = stage_of(scene);
  const int count = tiles.columns * tiles.rows;
  FilmBounds result;
  result.tiles.resize(static_cast<std::size_t>(count));
  result.lenses.resize(scene.lenses.size());
  // Each thread keeps its own maxima; the largest of them do not depend on who found them.
  tbb::enumerable_thread_specific<std::vector<LensBound>> found(
      [&] { return std::vector<LensBound>(scene.lenses.size()); });
  tbb::parallel_for(tbb::blocked_range<int>(0, count), [&](const tbb::blocked_range<int>& range) {
    std::vector<LensBound>& lenses = found.local();
    for (int i = range.begin(); i != range.end(); ++i) {
      const Bundle bundle = bundle_of(scene.camera, film_tile(scene.camera, tiles, i));
      result.tiles[static_cast<std::size_t>(i)] = bound_tile(stage, everything, bundle, lenses);
    }
  });
  for (const auto& lenses : found) merge(lenses, result.lenses);
  return result;
}

}  // namespace lensplane
