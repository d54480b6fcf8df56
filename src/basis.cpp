// SPDX-License-Identifier: Apache-2.0

#include "src/basis.h"

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

/// `v` made one long, or zero. Scaled first, so that the longest and the shortest vectors do not over- or
/// underflow.
Vec3 unit(const Vec3& v) {
  const double longest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return longest > 0 ? (v / longest).normalized() : Vec3(0);
}

}  // namespace

Basis parent_from_local(const Basis& outer, const Basis& inner) {
  return {outer.parent_from_local(inner.x), outer.parent_from_local(inner.y),
          outer.parent_from_local(inner.z)};
}

Basis local_from_parent(const Basis& frame, const Basis& basis) {
  return {frame.local_from_parent(basis.x), frame.local_from_parent(basis.y),
          frame.local_from_parent(basis.z)};
}

Basis basis_from_zxy(const Vec3& angles_rad) {
  const double cx = std::cos(angles_rad.x), sx = std::sin(angles_rad.x);
  const double cy = std::cos(angles_rad.y), sy = std::sin(angles_rad.y);
  const double cz = std::cos(angles_rad.z), sz = std::sin(angles_rad.z);
  const Basis about_x{{1, 0, 0}, {0, cx, sx}, {0, -sx, cx}};
  const Basis about_y{{cy, 0, -sy}, {0, 1, 0}, {sy, 0, cy}};
  const Basis about_z{{cz, sz, 0}, {-sz, cz, 0}, {0, 0, 1}};
  return parent_from_local(about_y, parent_from_local(about_x, about_z));
}

Basis basis_looking_along(const Vec3& forward, const Vec3& up) {
  const Vec3 z = -unit(forward);
  const Vec3 x = unit(up).cross(z);
  // Nearer than this to parallel, "up" says nothing reliable about which way is up.
  constexpr double kParallel = 1e-9;
  if (!(x.length() > kParallel)) return {Vec3(0), Vec3(0), Vec3(0)};
  const Vec3 unit_x = x.normalized();
  return {unit_x, z.cross(unit_x), z};
}

bool is_valid(const Basis& basis) {
  return basis.x.length2() > 0.5;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return 2.0 * std::atan2((a - b).length(), (a + b).length());
}

}  // namespace lensplane
