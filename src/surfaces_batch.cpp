// SPDX-License-Identifier: Apache-2.0

#include "src/surfaces_batch.h"

#include <cmath>
#include <limits>

namespace lensplane {

LENSPLANE_KERNEL
void enter_sphere(const Vec3& centre, double radius, double end_z, const RayBatch& rays, BatchArray& entry) {
  const double to_z = centre.z - rays.start_z;
  const double depth = end_z - rays.start_z;
  const double earliest = -kSurfaceTolerance * radius;
#pragma GCC ivdep  // the arrays are all different ones
  for (int i = 0; i < kBatchSize; ++i) {
    const double to_x = centre.x - rays.start_x[i];
    const double to_y = centre.y - rays.start_y[i];
    const double along = to_x * rays.dir_x[i] + to_y * rays.dir_y[i] + to_z * rays.dir_z[i];
    const double across_x = to_x - along * rays.dir_x[i];
    const double across_y = to_y - along * rays.dir_y[i];
    const double across_z = to_z - along * rays.dir_z[i];
    const double half_chord2 =
        radius * radius - (across_x * across_x + across_y * across_y + across_z * across_z);
    const double near = along - std::sqrt(half_chord2 > 0.0 ? half_chord2 : 0.0);
    const bool enters = (half_chord2 >= 0.0) & (near >= earliest) & (near <= depth / rays.dir_z[i]);
    entry[i] = enters ? near : std::numeric_limits<double>::infinity();
  }
}

LENSPLANE_KERNEL
void meet_plate(const Camera& camera, const BatchArray& x, const BatchArray& y, const RayBatch& rays,
                BatchArray& s, BatchArray& t, BatchArray& in_front) {
  const double pixels_per_slope = 1.0 / slope_per_pixel(camera);
  const double width = camera.width;
  const double height = camera.height;
#pragma GCC ivdep  // the arrays are all different ones
  for (int i = 0; i < kBatchSize; ++i) {
    const double per_depth = 1.0 / -rays.dir_z[i];
    const double moved_right = rays.dir_x[i] * per_depth - rays.first_right[i];
    const double moved_up = rays.dir_y[i] * per_depth - rays.first_up[i];
    s[i] = (x[i] + moved_right * pixels_per_slope) / width;
    t[i] = 1.0 - (y[i] - moved_up * pixels_per_slope) / height;
    const bool seen =
        (rays.dir_z[i] < 0.0) & (std::abs(s[i]) <= kPlateLimit) & (std::abs(t[i]) <= kPlateLimit);
    in_front[i] = seen ? 1.0 : 0.0;
  }
}

}  // namespace lensplane
