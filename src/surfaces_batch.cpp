// SPDX-License-Identifier: Apache-2.0

#include "src/surfaces_batch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace lensplane {

template <class Number>
LENSPLANE_KERNEL void end_nearest(const Vec3& point, bool finite, const LineBatch<Number>& rays, Ends& ends) {
  const double least = finite ? 0.0 : -std::numeric_limits<double>::infinity();
#pragma GCC ivdep  // the arrays are all different ones
  for (int i = 0; i < kBatchSize; ++i) {
    const double along = (point.x - rays.start.x.v[i]) * rays.direction.x.v[i] +
                         (point.y - rays.start.y.v[i]) * rays.direction.y.v[i] +
                         (point.z - rays.start.z.v[i]) * rays.direction.z.v[i];
    ends.at[i] = along > least ? along : least;
  }
}

LENSPLANE_KERNEL
void end_at_plane(double distance, const LineBatch<double>& rays, Ends& ends) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    ends.at[i] = (-distance - rays.start.z.v[i]) / rays.direction.z.v[i];
  }
}

template <class Number>
LENSPLANE_KERNEL void enter_sphere(const Sphere& sphere, const VectorLane<Number>& start,
                                   const VectorLane<Number>& direction, const Ends& ends, BatchArray& entry) {
  const Vec3 centre = sphere.centre;
  const double radius2 = sphere.radius * sphere.radius;
  const double earliest = -kSurfaceTolerance * sphere.radius;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double dx = direction.x.v[i], dy = direction.y.v[i], dz = direction.z.v[i];
    const double to_x = centre.x - start.x.v[i];
    const double to_y = centre.y - start.y.v[i];
    const double to_z = centre.z - start.z.v[i];
    const double along = to_x * dx + to_y * dy + to_z * dz;
    const double across_x = to_x - along * dx;
    const double across_y = to_y - along * dy;
    const double across_z = to_z - along * dz;
    const double half_chord2 = radius2 - (across_x * across_x + across_y * across_y + across_z * across_z);
    const double near = along - std::sqrt(half_chord2 > 0.0 ? half_chord2 : 0.0);
    const bool enters = (half_chord2 >= 0.0) & (near >= earliest) & (near <= ends.at[i]);
    entry[i] = enters ? near : std::numeric_limits<double>::infinity();
  }
}

template <class Number>
LENSPLANE_KERNEL void end_sides(const Disc& disc, const LineBatch<Number>& rays, const Ends& ends,
                                BatchArray& sides) {
  const Vec3 n = disc.normal, centre = disc.centre;
  const double tolerance = disc.tolerance;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double dx = rays.direction.x.v[i], dy = rays.direction.y.v[i], dz = rays.direction.z.v[i];
    const bool leaves = !(ends.at[i] < std::numeric_limits<double>::infinity());
    const double length = leaves ? 0.0 : ends.at[i];
    const double rate = n.x * dx + n.y * dy + n.z * dz;
    const double height = n.x * (rays.start.x.v[i] + dx * length - centre.x) +
                          n.y * (rays.start.y.v[i] + dy * length - centre.y) +
                          n.z * (rays.start.z.v[i] + dz * length - centre.z);
    const double near = height > tolerance ? 1.0 : -1.0;
    const double far = rate > 0.0 ? 1.0 : rate < 0.0 ? -1.0 : 0.0;
    const double forward = length > 0.0 ? near : 0.0;
    sides[i] = leaves ? far : forward;
  }
}

namespace {

/// Where a kernel writes (s, t) and what comes with it.
struct PlateTarget {
  double *s, *t;
  double* unseen;                                         // 0, or 1 where the plate has no picture
  double *ds_dx, *ds_dy, *dt_dx, *dt_dy, *magnification;  // with Dual numbers
};

template <class Number>
LENSPLANE_KERNEL void plate_coordinates(const Camera& camera, double slope, const BatchArray& x,
                                        const BatchArray& y, const LineBatch<Number>& rays,
                                        const PlateTarget& to) {
  const double pixels_per_slope = 1.0 / slope;
  const double centre_x = camera.width / 2.0, centre_y = camera.height / 2.0;
  const double per_width = 1.0 / camera.width, per_height = 1.0 / camera.height;
  const PlateTarget target = to;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vector<Number> d = rays.direction.get(i);
    const double d_z = value_of(d.z);
    const double per_depth = -1.0 / d_z;
    const double right = x[i] - centre_x, up = centre_y - y[i];
    // How far the picture has moved, so that light which is hardly bent keeps all digits of its pixel.
    const double slope_x = value_of(d.x) * per_depth, slope_y = value_of(d.y) * per_depth;
    const double s = (x[i] + (slope_x * pixels_per_slope - right)) * per_width;
    const double t = 1.0 - (y[i] - (slope_y * pixels_per_slope - up)) * per_height;
    const bool seen = (d_z < 0.0) & (std::abs(s) <= kPlateLimit) & (std::abs(t) <= kPlateLimit);
    target.s[i] = seen ? s : 0.0;
    target.t[i] = seen ? t : 0.0;
    target.unseen[i] = seen ? 0.0 : 1.0;
    if constexpr (std::is_same_v<Number, Dual>) {
      // Derivatives of the slopes, in pixels.
      const double scale = per_depth * pixels_per_slope;
      const double x_dx = (d.x.dx + slope_x * d.z.dx) * scale, x_dy = (d.x.dy + slope_x * d.z.dy) * scale;
      const double y_dx = (d.y.dx + slope_y * d.z.dx) * scale, y_dy = (d.y.dy + slope_y * d.z.dy) * scale;
      target.ds_dx[i] = seen ? x_dx * per_width : 0.0;
      target.ds_dy[i] = seen ? x_dy * per_width : 0.0;
      target.dt_dx[i] = seen ? y_dx * per_height : 0.0;
      target.dt_dy[i] = seen ? y_dy * per_height : 0.0;
      // Solid angle by area of the film: the cube of the depth of a unit vector. Film y points down.
      const double depth2 = 1.0 + slope * slope * (right * right + up * up);
      const double depth2_there = 1.0 + slope_x * slope_x + slope_y * slope_y;
      const double ratio = depth2_there / depth2;
      const double mu = ratio * std::sqrt(ratio) / (x_dy * y_dx - x_dx * y_dy);
      const double least = mu > -kLargestMagnification ? mu : -kLargestMagnification;
      const double clamped = least < kLargestMagnification ? least : kLargestMagnification;
      target.magnification[i] = seen ? clamped : 0.0;
    }
  }
}

}  // namespace

template <class Number>
void meet_plate(const Camera& camera, double slope, const BatchArray& x, const BatchArray& y,
                const LineBatch<Number>& rays, SurfaceBatch& surface) {
  alignas(64) BatchArray unseen;
  PlateTarget target{surface.s, surface.t, unseen, nullptr, nullptr, nullptr, nullptr, nullptr};
  if constexpr (std::is_same_v<Number, Dual>) {
    PassBatch& p = *surface.passes;
    target = {surface.s, surface.t, unseen, p.ds_dx, p.ds_dy, p.dt_dx, p.dt_dy, p.magnification};
  }
  plate_coordinates(camera, slope, x, y, rays, target);
  std::fill_n(surface.distance, kBatchSize, std::numeric_limits<double>::infinity());
  surface.outcome.fill(Outcome::Hit);
  if (!any_of(unseen)) return;
  for (std::size_t i = 0; i < kBatchSize; ++i) {
    if (unseen[i] != 0.0) surface.outcome[i] = Outcome::Behind;
  }
}

template void end_nearest(const Vec3&, bool, const LineBatch<double>&, Ends&);
template void end_nearest(const Vec3&, bool, const LineBatch<Dual>&, Ends&);
template void enter_sphere(const Sphere&, const VectorLane<double>&, const VectorLane<double>&, const Ends&,
                           BatchArray&);
template void enter_sphere(const Sphere&, const VectorLane<Dual>&, const VectorLane<Dual>&, const Ends&,
                           BatchArray&);
template void end_sides(const Disc&, const LineBatch<double>&, const Ends&, BatchArray&);
template void end_sides(const Disc&, const LineBatch<Dual>&, const Ends&, BatchArray&);
template void meet_plate(const Camera&, double, const BatchArray&, const BatchArray&,
                         const LineBatch<double>&, SurfaceBatch&);
template void meet_plate(const Camera&, double, const BatchArray&, const BatchArray&, const LineBatch<Dual>&,
                         SurfaceBatch&);

}  // namespace lensplane
