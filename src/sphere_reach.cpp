// SPDX-License-Identifier: Apache-2.0

#include "src/sphere_reach.h"

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

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

}  // namespace

template <class Number>
void find_near(const Stretches<Number>& stretches, const Sphere& sphere, BatchArray& near) {
  alignas(64) BatchArray way, slack;
  std::fill_n(slack, kBatchSize, 0.0);
  way_nearest(sphere.centre, stretches.rays, stretches.ends, way);
  if (stretches.finite) add_slack(*stretches.finite, stretches.bends, stretches.rays, way, slack);
  compare(sphere, stretches.rays, way, slack, near);
}

template <class Number>
void add_near_chords(const Stretches<Number>& before, const LineBatch<Number>& after, const Sphere& sphere,
                     BatchArray& near) {
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
