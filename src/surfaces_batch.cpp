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
LENSPLANE_KERNEL void plate_coordinates(const Camera& camera, const BatchArray& x, const BatchArray& y,
                                        const LineBatch<Number>& rays, const PlateTarget& to) {
  const double slope = slope_per_pixel(camera);
  const double pixels_per_slope = 1.0 / slope;
  const double centre_x = camera.width / 2.0, centre_y = camera.height / 2.0;
  const double per_width = 1.0 / camera.width, per_height = 1.0 / camera.height;
  const PlateTarget target = to;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vector<Number> d = rays.direction.get(i);
    const Number per_depth = pixels_per_slope * reciprocal(-d.z);
    const double right = x[i] - centre_x, up = centre_y - y[i];
    // How far the picture has moved, so that light which is hardly bent keeps all digits of its pixel.
    const Number moved_right = d.x * per_depth - Number(right);
    const Number moved_up = d.y * per_depth - Number(up);
    const Number s = (Number(x[i]) + moved_right) * per_width;
    const Number t = Number(1.0) - (Number(y[i]) - moved_up) * per_height;
    const bool seen = (value_of(d.z) < 0.0) & (std::abs(value_of(s)) <= kPlateLimit) &
                      (std::abs(value_of(t)) <= kPlateLimit);
    target.s[i] = seen ? value_of(s) : 0.0;
    target.t[i] = seen ? value_of(t) : 0.0;
    target.unseen[i] = seen ? 0.0 : 1.0;
    if constexpr (std::is_same_v<Number, Dual>) {
      target.ds_dx[i] = seen ? s.dx : 0.0;
      target.ds_dy[i] = seen ? s.dy : 0.0;
      target.dt_dx[i] = seen ? t.dx : 0.0;
      target.dt_dy[i] = seen ? t.dy : 0.0;
      const double cross_x = d.y.dx * d.z.dy - d.z.dx * d.y.dy;
      const double cross_y = d.z.dx * d.x.dy - d.x.dx * d.z.dy;
      const double cross_z = d.x.dx * d.y.dy - d.y.dx * d.x.dy;
      const double there = d.x.v * cross_x + d.y.v * cross_y + d.z.v * cross_z;
      // A pixel's solid angle, in closed form; film y points down.
      const double at_unit_depth = 1.0 + slope * slope * (right * right + up * up);
      const double mu = slope * slope / (at_unit_depth * std::sqrt(at_unit_depth) * there);
      const double least = mu > -kLargestMagnification ? mu : -kLargestMagnification;
      const double clamped = least < kLargestMagnification ? least : kLargestMagnification;
      target.magnification[i] = seen ? clamped : 0.0;
    }
  }
}

}  // namespace

template <class Number>
void meet_plate(const Camera& camera, const BatchArray& x, const BatchArray& y, const LineBatch<Number>& rays,
                SurfaceBatch& surface) {
  alignas(64) BatchArray unseen;
  PlateTarget target{surface.s, surface.t, unseen, nullptr, nullptr, nullptr, nullptr, nullptr};
  if constexpr (std::is_same_v<Number, Dual>) {
    PassBatch& p = *surface.passes;
    target = {surface.s, surface.t, unseen, p.ds_dx, p.ds_dy, p.dt_dx, p.dt_dy, p.magnification};
  }
  plate_coordinates(camera, x, y, rays, target);
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
template void meet_plate(const Camera&, const BatchArray&, const BatchArray&, const LineBatch<double>&,
                         SurfaceBatch&);
template void meet_plate(const Camera&, const BatchArray&, const BatchArray&, const LineBatch<Dual>&,
                         SurfaceBatch&);

}  // namespace lensplane
