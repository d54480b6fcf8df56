// SPDX-License-Identifier: Apache-2.0

#include "src/march.h"

#include <cmath>

#include "src/deflection.h"

namespace lensplane {
namespace {

double length_of(const Vec3& v) {
  return std::hypot(v.x, v.y, v.z);  // unlike a sum of squares, neither overflows nor underflows
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The nearest plane ahead of a ray at height `z`: -1 or planes.size() when there is none. `planes` descend
/// in z.
int plane_ahead(const std::vector<LensPlane>& planes, double z, double direction_z) {
  int index = 0;
  const int count = static_cast<int>(planes.size());
  if (direction_z < 0.0) {
    while (index < count && !(planes[index].z < z)) ++index;
    return index;
  }
  if (direction_z == 0.0) return count;
  while (index < count && planes[index].z > z) ++index;
  return index - 1;
}

}  // namespace

std::optional<Vec3> bend(const Vec3& direction, const Vec3& to_source, double m) {
  const double b = length_of(to_source);
  const double alpha = weak_deflection(m, b);
  if (!std::isfinite(alpha)) return std::nullopt;
  const Vec3 v_g = to_source / b;                                    // (1)
  const Vec3 towards_source = v_g - direction * v_g.dot(direction);  // (2), (3): V_ray x (V_g x V_ray)
  const double length = length_of(towards_source);
  if (length == 0.0) return std::nullopt;
  const Vec3 v_rot = towards_source / length;
  const Vec3 v_new = direction * std::cos(alpha) + v_rot * std::sin(alpha);  // (5), (6) times cos(alpha)
  return v_new / length_of(v_new);
}

RayPath march(const std::vector<LensPlane>& planes, const Vec3& start, const Vec3& direction) {
  RayPath path{{{start, direction}}};
  int next = plane_ahead(planes, start.z, direction.z);
  for (int crossings = 0; next >= 0 && next < static_cast<int>(planes.size()); ++crossings) {
    const LensPlane& plane = planes[next];
    RaySegment& segment = path.segments.back();
    const double length = (plane.z - segment.start.z) / segment.direction.z;
    Vec3 crossing = segment.start + segment.direction * length;
    crossing.z = plane.z;
    if (!is_finite(crossing)) return path;  // as good as parallel to the plane
    segment.length = length;

    Vec3 v_ray = segment.direction;
    for (const Source& source : plane.sources) {
      const Vec3 to_source(source.x - crossing.x, source.y - crossing.y, 0.0);
      const std::optional<Vec3> bent = bend(v_ray, to_source, source.m);
      path.captured = !bent || crossings == kMaxCrossings;
      if (path.captured) return path;
      v_ray = *bent;
    }
    path.segments.push_back({crossing, v_ray});
    if (v_ray.z == 0.0) return path;
    next += v_ray.z < 0.0 ? 1 : -1;
  }
  return path;
}

}  // namespace lensplane
