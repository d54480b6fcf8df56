// SPDX-License-Identifier: Apache-2.0

#include "src/surfaces_batch.h"

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

namespace {

/// What a plate's picture is seen at: s and t, or zero where it has none.
struct PlateLanes {
  Lane<double> seen, magnification;
};

template <class Number>
LENSPLANE_KERNEL void plate_coordinates(const Camera& camera, const BatchArray& x, const BatchArray& y,
                                        const LineBatch<Number>& rays, Lane<Number>& s, Lane<Number>& t,
                                        PlateLanes& lanes) {
  const double slope = slope_per_pixel(camera);
  const double pixels_per_slope = 1.0 / slope;
  const double centre_x = camera.width / 2.0, centre_y = camera.height / 2.0;
  const double per_width = 1.0 / camera.width, per_height = 1.0 / camera.height;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vector<Number> d = rays.direction.get(i);
    const Number per_depth = reciprocal(-d.z);
    const double right = x[i] - centre_x, up = centre_y - y[i];
    // How far the picture has moved, so that light which is hardly bent keeps all digits of its pixel.
    const Number moved_right = pixels_per_slope * (d.x * per_depth) - Number(right);
    const Number moved_up = pixels_per_slope * (d.y * per_depth) - Number(up);
    const Number s_there = (Number(x[i]) + moved_right) * per_width;
    const Number t_there = Number(1.0) - (Number(y[i]) - moved_up) * per_height;
    const bool seen = (value_of(d.z) < 0.0) & (std::abs(value_of(s_there)) <= kPlateLimit) &
                      (std::abs(value_of(t_there)) <= kPlateLimit);
    s.set(i, select(seen, s_there, Number(0.0)));
    t.set(i, select(seen, t_there, Number(0.0)));
    lanes.seen.v[i] = seen ? 1.0 : 0.0;
    if constexpr (std::is_same_v<Number, Dual>) {
      const double cross_x = d.y.dx * d.z.dy - d.z.dx * d.y.dy;
      const double cross_y = d.z.dx * d.x.dy - d.x.dx * d.z.dy;
      const double cross_z = d.x.dx * d.y.dy - d.y.dx * d.x.dy;
      const double there = d.x.v * cross_x + d.y.v * cross_y + d.z.v * cross_z;
      // A pixel's solid angle, in closed form; film y points down.
      const double at_unit_depth = 1.0 + slope * slope * (right * right + up * up);
      const double here = slope * slope / (at_unit_depth * std::sqrt(at_unit_depth));
      const double mu = here / there;
      const double least = mu > -kLargestMagnification ? mu : -kLargestMagnification;
      lanes.magnification.v[i] = least < kLargestMagnification ? least : kLargestMagnification;
    }
  }
}

}  // namespace

template <class Number>
void meet_plate(const Camera& camera, const BatchArray& x, const BatchArray& y, const LineBatch<Number>& rays,
                SurfaceBatch& surface) {
  Lane<Number> s, t;
  PlateLanes lanes;
  plate_coordinates(camera, x, y, rays, s, t, lanes);
  for (int i = 0; i < kBatchSize; ++i) {
    surface.s[i] = value_of(s.get(i));
    surface.t[i] = value_of(t.get(i));
    surface.distance[i] = std::numeric_limits<double>::infinity();
  }
  double seen = 0.0;
  for (int i = 0; i < kBatchSize; ++i) seen += lanes.seen.v[i];
  surface.outcome.fill(Outcome::Hit);
  for (int i = 0; seen < kBatchSize && i < kBatchSize; ++i) {
    if (lanes.seen.v[i] == 0.0) surface.outcome[i] = Outcome::Behind;
  }
  if constexpr (std::is_same_v<Number, Dual>) {
    PassBatch& passes = *surface.passes;
    for (int i = 0; i < kBatchSize; ++i) {
      passes.ds_dx[i] = s.dx[i];
      passes.ds_dy[i] = s.dy[i];
      passes.dt_dx[i] = t.dx[i];
      passes.dt_dy[i] = t.dy[i];
      passes.magnification[i] = lanes.magnification.v[i];
    }
  }
}

template void end_nearest(const Vec3&, bool, const LineBatch<double>&, Ends&);
template void end_nearest(const Vec3&, bool, const LineBatch<Dual>&, Ends&);
template void enter_sphere(const Sphere&, const VectorLane<double>&, const VectorLane<double>&, const Ends&,
                           BatchArray&);
template void enter_sphere(const Sphere&, const VectorLane<Dual>&, const VectorLane<Dual>&, const Ends&,
                           BatchArray&);
template void meet_plate(const Camera&, const BatchArray&, const BatchArray&, const LineBatch<double>&,
                         SurfaceBatch&);
template void meet_plate(const Camera&, const BatchArray&, const BatchArray&, const LineBatch<Dual>&,
                         SurfaceBatch&);

}  // namespace lensplane
