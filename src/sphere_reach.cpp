// SPDX-License-Identifier: Apache-2.0

#include "src/sphere_reach.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "src/ray_bundle.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Has the mass's plane bent the rays?
enum class Side { Before, JustBeyond, Beyond };

Side side_of(int plane, int bends) {
  return plane >= bends ? Side::Before : plane == bends - 1 ? Side::JustBeyond : Side::Beyond;
}

/// Adds to `slack` by how much one mass shifts light within `way[i]` metres of the starts at most.
template <class Number>
LENSPLANE_KERNEL void add_slack(const Deflector& deflector, Side side, const VectorLane<Number>& start,
                                const VectorLane<Number>& direction, const BatchArray& way,
                                BatchArray& slack) {
  const Vec3 mass = deflector.position;
  const double shift = 2.0 * deflector.m;
  const bool before = side == Side::Before, just = side == Side::JustBeyond;
  constexpr double kTiny = 1e-300;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double dx = direction.x.v[i], dy = direction.y.v[i], dz = direction.z.v[i];
    const double to_x = mass.x - start.x.v[i], to_y = mass.y - start.y.v[i], to_z = mass.z - start.z.v[i];
    const double along = to_x * dx + to_y * dy + to_z * dz;
    const double across_x = to_x - along * dx, across_y = to_y - along * dy, across_z = to_z - along * dz;
    const double b = std::sqrt(across_x * across_x + across_y * across_y + across_z * across_z) + kTiny;
    const double camera = mass.x * dx + mass.y * dy + mass.z * dz;
    const double beyond = way[i] - along, behind_camera = along - camera;
    const double over = before ? (beyond > 0.0 ? beyond : 0.0) + (behind_camera > 0.0 ? behind_camera : 0.0)
                        : just ? (along > 0.0 ? along : 0.0)
                               : 0.0;
    slack[i] += shift * (1.0 + 2.0 * over / b);
  }
}

template <class Number>
void add_slack(const Deflectors& deflectors, int bends, const LineBatch<Number>& rays, const BatchArray& way,
               BatchArray& slack) {
  for (std::size_t k = 0; k < deflectors.outward; ++k) {
    for (const Deflector& deflector : deflectors.planes[k].deflectors) {
      add_slack(deflector, side_of(static_cast<int>(k), bends), rays.start, rays.direction, way, slack);
    }
  }
}

/// Metres along each stretch to where it is nearest to a point.
template <class Number>
LENSPLANE_KERNEL void way_nearest(const Vec3& point, const LineBatch<Number>& rays, const Ends& ends,
                                  BatchArray& way) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double along = (point.x - rays.start.x.v[i]) * rays.direction.x.v[i] +
                         (point.y - rays.start.y.v[i]) * rays.direction.y.v[i] +
                         (point.z - rays.start.z.v[i]) * rays.direction.z.v[i];
    const double ahead = along > 0.0 ? along : 0.0;
    way[i] = ahead < ends.at[i] ? ahead : ends.at[i];
  }
}

/// Is what lies `way` along a stretch as near to the sphere as the slack allows? A line through two shifted
/// points, `way` apart, is shifted more beyond them: by up to the sphere's size over that.
template <class Number>
LENSPLANE_KERNEL void compare(const Sphere& sphere, const LineBatch<Number>& rays, const BatchArray& way,
                              const BatchArray& slack, BatchArray& near) {
  const Vec3 centre = sphere.centre;
  const double radius = sphere.radius * (1.0 + 1e-9);
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double x = rays.start.x.v[i] + way[i] * rays.direction.x.v[i] - centre.x;
    const double y = rays.start.y.v[i] + way[i] * rays.direction.y.v[i] - centre.y;
    const double z = rays.start.z.v[i] + way[i] * rays.direction.z.v[i] - centre.z;
    const double stretched = way[i] > 0.0 ? 1.0 + 2.0 * radius / way[i] : 1.0;
    const double limit = radius + slack[i] * stretched;
    near[i] = x * x + y * y + z * z > limit * limit ? 0.0 : 1.0;
  }
}

/// Adds chords as compare() does stretches; the chord runs from `way` along its stretch to `to`.
template <class Number>
LENSPLANE_KERNEL void compare_chords(const Sphere& sphere, const LineBatch<Number>& rays,
                                     const BatchArray& way, const VectorLane<Number>& to,
                                     const BatchArray& slack, BatchArray& near) {
  const Vec3 centre = sphere.centre;
  const double radius = sphere.radius * (1.0 + 1e-9);
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double x = rays.start.x.v[i] + way[i] * rays.direction.x.v[i];
    const double y = rays.start.y.v[i] + way[i] * rays.direction.y.v[i];
    const double z = rays.start.z.v[i] + way[i] * rays.direction.z.v[i];
    const double dx = to.x.v[i] - x, dy = to.y.v[i] - y, dz = to.z.v[i] - z;
    const double cx = x - centre.x, cy = y - centre.y, cz = z - centre.z;
    // No point of a chord is farther from its start than its length.
    const double limit = radius + slack[i] + std::sqrt(dx * dx + dy * dy + dz * dz);
    near[i] = cx * cx + cy * cy + cz * cz > limit * limit ? near[i] : 1.0;
  }
}

/// At least as much as add_slack() adds to any ray of the bundle within `way` metres; infinite where they may
/// meet the mass.
double most_slack(const Deflector& deflector, Side side, const RayBundle& bundle, double way) {
  const auto way_by = bundle.along(deflector.position);
  const auto [from, to] = way_by;
  const double b = bundle.distance_from(deflector.position, way_by);
  if (!(b > 0.0)) return kInfinity;
  double over = 0.0;
  if (side == Side::Before) {
    const double behind_camera = bundle.along(Vec3(0)).second;
    over = std::max(way - from, 0.0) + std::max(behind_camera, 0.0);
  } else if (side == Side::JustBeyond) {
    over = std::max(to, 0.0);
  }
  return 2.0 * deflector.m * (1.0 + 2.0 * over / b);
}

double most_slack(const Deflectors* finite, int bends, const RayBundle& bundle, double way) {
  double slack = 0.0;
  if (!finite) return slack;
  for (std::size_t k = 0; k < finite->outward; ++k) {
    for (const Deflector& deflector : finite->planes[k].deflectors) {
      slack += most_slack(deflector, side_of(static_cast<int>(k), bends), bundle, way);
    }
  }
  return slack;
}

// Rounding, of the scene's own lengths, is far less.
constexpr double kRounding = 1e-9;

/// Is no ray of the batch as near to the sphere as compare() allows?
template <class Number>
bool are_far(const Stretches<Number>& stretches, const Sphere& sphere) {
  const RayBundle bundle = bundle_of(stretches.rays);
  const auto [shortest, longest] =
      std::minmax_element(std::begin(stretches.ends.at), std::end(stretches.ends.at));
  const auto [from, to] = bundle.along(sphere.centre);
  const double least = std::min(std::max(from, 0.0), *shortest), most = std::min(std::max(to, 0.0), *longest);
  const double slack = most_slack(stretches.finite, stretches.bends, bundle, most);
  if (slack > 0.0 && most > 0.0 && !(least > 0.0)) return false;  // by how much is that stretched?
  const double stretched = least > 0.0 ? 1.0 + 2.0 * sphere.radius / least : 1.0;
  const Vec3 d = bundle.direction.centre, to_centre = sphere.centre - bundle.start.centre;
  const double nearest = std::clamp(to_centre.dot(d) / d.dot(d), least, most);
  const double off =
      bundle.start.radius + std::max(std::abs(least), std::abs(most)) * bundle.direction.radius;
  const double distance = length(to_centre - d * nearest);
  return distance - off - (sphere.radius + slack * stretched) > kRounding * (length(to_centre) + most);
}

template <class Number>
bool chords_are_far(const Stretches<Number>& before, const LineBatch<Number>& after, const Sphere& sphere) {
  const PointBall from = ball_of(before.rays.start, before.rays.direction, before.ends.at);
  const RayBundle next = bundle_of(after);
  const double longest = *std::max_element(std::begin(before.ends.at), std::end(before.ends.at));
  const double slack = most_slack(before.finite, before.bends, bundle_of(before.rays), longest) +
                       most_slack(before.finite, before.bends + 1, next, 0.0);
  const double chord = length(next.start.centre - from.centre) + from.radius + next.start.radius;
  const double distance = length(from.centre - sphere.centre);
  return distance - from.radius - (sphere.radius + slack + chord) >
         kRounding * (distance + length(from.centre));
}

}  // namespace

template <class Number>
void find_near(const Stretches<Number>& stretches, const Sphere& sphere, BatchArray& near) {
  std::fill_n(near, kBatchSize, 0.0);
  if (are_far(stretches, sphere)) return;
  alignas(64) BatchArray way, slack;
  std::fill_n(slack, kBatchSize, 0.0);
  way_nearest(sphere.centre, stretches.rays, stretches.ends, way);
  if (stretches.finite) add_slack(*stretches.finite, stretches.bends, stretches.rays, way, slack);
  compare(sphere, stretches.rays, way, slack, near);
}

template <class Number>
void add_near_chords(const Stretches<Number>& before, const LineBatch<Number>& after, const Sphere& sphere,
                     BatchArray& near) {
  if (chords_are_far(before, after, sphere)) return;
  alignas(64) BatchArray start, slack;
  std::fill_n(slack, kBatchSize, 0.0);
  std::fill_n(start, kBatchSize, 0.0);
  if (before.finite) {
    add_slack(*before.finite, before.bends, before.rays, before.ends.at, slack);
    add_slack(*before.finite, before.bends + 1, after, start, slack);
  }
  compare_chords(sphere, before.rays, before.ends.at, after.start, slack, near);
}

template void find_near(const Stretches<double>&, const Sphere&, BatchArray&);
template void find_near(const Stretches<Dual>&, const Sphere&, BatchArray&);
template void add_near_chords(const Stretches<double>&, const LineBatch<double>&, const Sphere&, BatchArray&);
template void add_near_chords(const Stretches<Dual>&, const LineBatch<Dual>&, const Sphere&, BatchArray&);

}  // namespace lensplane
