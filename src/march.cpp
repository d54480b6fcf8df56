// SPDX-License-Identifier: Apache-2.0

#include "src/march.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/deflection.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Number>
bool is_finite(const Vector<Number>& v) {
  return std::isfinite(value_of(v.x)) && std::isfinite(value_of(v.y)) && std::isfinite(value_of(v.z));
}

/// A direction after a bend, and by what it has turned, without loss of digits.
template <class Number>
struct Turned {
  Vector<Number> direction;
  Vec3 turn;
};

template <class Number>
std::optional<Turned<Number>> turned(const Vector<Number>& direction, const Vector<Number>& to_source,
                                     double m) {
  using std::cos, std::sin;
  const Number b = length(to_source);
  const double alpha0 = weak_deflection(m, value_of(b));
  if (!std::isfinite(alpha0)) return std::nullopt;
  const Number alpha = chained(b, alpha0, -alpha0 / value_of(b));
  const Vector<Number> v_g = to_source * reciprocal(b);                // (1)
  const Vector<Number> across = v_g - direction * v_g.dot(direction);  // (2), (3): V_ray x (V_g x V_ray)
  const Number share = length(across);
  if (value_of(share) == 0.0) return std::nullopt;
  const Vector<Number> v_rot = across * reciprocal(share);
  const Vector<Number> v_new = direction * cos(alpha) + v_rot * sin(alpha);  // (5), (6) times cos(alpha)
  const double half = std::sin(0.5 * alpha0);
  const Vec3 turn = value_of(v_rot) * std::sin(alpha0) - value_of(direction) * (2.0 * half * half);
  return Turned<Number>{v_new * reciprocal(length(v_new)), turn};
}

/// The part of a unit `direction` along the normal of a plane: the rate at which the ray nears it.
template <class Number>
Number rate(const LensPlane& plane, const Vector<Number>& direction) {
  return constant<Number>(plane.normal).dot(direction);
}

bool all_parallel(const std::vector<LensPlane>& planes) {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const LensPlane& plane) { return plane.normal == planes.front().normal; });
}

/// The nearest of parallel planes ahead of a ray that stands `distance` along their normal and moves along it
/// at `rate`: -1 or planes.size() when there is none.
int parallel_plane_ahead(const std::vector<LensPlane>& planes, double distance, double rate) {
  int index = 0;
  const int count = static_cast<int>(planes.size());
  if (rate > 0.0) {
    while (index < count && !(planes[index].distance > distance)) ++index;
    return index;
  }
  if (rate == 0.0) return count;
  while (index < count && planes[index].distance < distance) ++index;
  return index - 1;
}

/// Bends the ray that ends `path` by the plane's sources, `crossing` being where it meets the plane. False
/// when it is captured there.
template <class Number>
bool cross(const LensPlane& plane, const Vector<Number>& crossing, const Number& stretch,
           RayPath<Number>& path) {
  path.segments.back().length = stretch;
  const Number travelled = path.lengths.back() + stretch;
  Vector<Number> v_ray = path.segments.back().direction;
  Corner corner;
  path.unresolved = path.bends == kMaxCrossings;
  if (path.unresolved) return false;
  for (const Source& source : plane.sources) {
    const Vector<Number> to_source = constant<Number>(source.position) - crossing;
    const std::optional<Turned<Number>> bent = turned(v_ray, to_source, source.m);
    path.captured = !bent;
    if (path.captured) return false;
    const Number b = length(to_source);
    const Number alpha = chained(b, weak_deflection(source.m, value_of(b)),
                                 -weak_deflection(source.m, value_of(b)) / value_of(b));
    path.passages.push_back({source.lens, source.m, length(source.position), b, alpha, travelled});
    v_ray = bent->direction;
    corner.turn += bent->turn;
  }
  path.segments.push_back({crossing, v_ray, Number(kInfinity), ++path.bends});
  path.lengths.push_back(travelled);
  path.corners.push_back(corner);
  return true;
}

/// Where the ray that ends `path` meets the plane ahead, and after what length; nothing when that is too far
/// away for numbers: it is as good as parallel.
template <class Number>
struct Crossing {
  Vector<Number> point;
  Number length;
};
template <class Number>
std::optional<Crossing<Number>> crossing_of(const LensPlane& plane, const RaySegment<Number>& ray) {
  const Vector<Number> normal = constant<Number>(plane.normal);
  const Number length = (Number(plane.distance) - ray.start.dot(normal)) / rate(plane, ray.direction);
  Vector<Number> point = ray.start + ray.direction * length;
  if (plane.normal == Vec3(0, 0, -1)) point.z = -plane.distance;
  if (!is_finite(point)) return std::nullopt;
  return Crossing<Number>{point, length};
}

template <class Number>
RayPath<Number> march_parallel(const std::vector<LensPlane>& planes, RayPath<Number> path) {
  const Vec3 start = value_of(path.segments.front().start);
  const Vec3 direction = value_of(path.segments.front().direction);
  if (planes.empty()) return path;
  int next = parallel_plane_ahead(planes, planes.front().normal.dot(start), rate(planes.front(), direction));
  while (next >= 0 && next < static_cast<int>(planes.size())) {
    const LensPlane& plane = planes[next];
    const auto crossing = crossing_of(plane, path.segments.back());
    if (!crossing || !cross(plane, crossing->point, crossing->length, path)) return path;
    const double onward = rate(plane, value_of(path.segments.back().direction));
    if (onward == 0.0) return path;
    next += onward > 0.0 ? 1 : -1;
  }
  return path;
}

template <class Number>
RayPath<Number> march_outward(const std::vector<LensPlane>& planes, RayPath<Number> path) {
  for (const LensPlane& plane : planes) {
    if (!(rate(plane, value_of(path.segments.back().direction)) > 0.0)) continue;
    const auto crossing = crossing_of(plane, path.segments.back());
    if (!crossing || !(value_of(crossing->length) >= 0.0)) continue;
    if (!cross(plane, crossing->point, crossing->length, path)) return path;
  }
  return path;
}

}  // namespace

template <class Number>
std::optional<Vector<Number>> bend(const Vector<Number>& direction, const Vector<Number>& to_source,
                                   double m) {
  const auto bent = turned(direction, to_source, m);
  return bent ? std::optional(bent->direction) : std::nullopt;
}

template <class Number>
RayPath<Number> march(const std::vector<LensPlane>& planes, const Vector<Number>& start,
                      const Vector<Number>& direction) {
  RayPath<Number> path = path_from<Number>(start, direction);
  return all_parallel(planes) ? march_parallel(planes, std::move(path))
                              : march_outward(planes, std::move(path));
}

template std::optional<Vec3> bend(const Vec3&, const Vec3&, double);
template std::optional<DualVec3> bend(const DualVec3&, const DualVec3&, double);
template RayPath<double> march(const std::vector<LensPlane>&, const Vec3&, const Vec3&);
template RayPath<Dual> march(const std::vector<LensPlane>&, const DualVec3&, const DualVec3&);

}  // namespace lensplane
