// SPDX-License-Identifier: Apache-2.0

#include "src/surfaces.h"

#include <cmath>
#include <limits>

#include "src/constants.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SurfaceHit meet_plate(const Camera& camera, FilmPosition film, const Vec3& first, const Vec3& last) {
  SurfaceHit hit{Outcome::Behind, {0, 0}, kInfinity};
  if (!(last.z < 0.0)) return hit;
  // The change of slope, not the slope: exactly zero for a ray that is not bent, however narrow the view.
  const double per_pixel = slope_per_pixel(camera);
  const double moved_right = (last.x / -last.z - first.x / -first.z) / per_pixel;
  const double moved_up = (last.y / -last.z - first.y / -first.z) / per_pixel;
  const TextureCoordinates st{(film.x + moved_right) / camera.width,
                              1.0 - (film.y - moved_up) / camera.height};
  if (!(std::abs(st.s) <= kPlateLimit && std::abs(st.t) <= kPlateLimit)) return hit;
  return {Outcome::Hit, st, kInfinity};
}

SurfaceHit meet_sphere(const Sphere& sphere, const RayPath& path) {
  double travelled = 0.0;
  for (const RaySegment& segment : path.segments) {
    const double entry = sphere_entry(segment.start, segment.direction, sphere.centre, sphere.radius);
    if (entry <= segment.length && entry < kInfinity) {
      const Vec3 normal = segment.start + segment.direction * entry - sphere.centre;
      return {Outcome::Hit, st_from_sphere_normal(sphere.axes.local_from_parent(normal)), travelled + entry};
    }
    travelled += segment.length;
  }
  return {path.captured ? Outcome::Captured : Outcome::Missed, {0, 0}, 0};
}

}  // namespace

double sphere_entry(const Vec3& start, const Vec3& direction, const Vec3& centre, double radius) {
  const Vec3 to_centre = centre - start;
  const double along = to_centre.dot(direction);
  const Vec3 across = to_centre - direction * along;
  const double half_chord2 = radius * radius - across.dot(across);
  if (!(half_chord2 >= 0.0)) return kInfinity;
  const double near = along - std::sqrt(half_chord2);
  return near >= -kSurfaceTolerance * radius ? near : kInfinity;
}

TextureCoordinates st_from_sphere_normal(const Vec3& n) {
  return {0.5 + std::atan2(n.x, n.z) / (2.0 * kPi), 0.5 + std::atan2(n.y, std::hypot(n.x, n.z)) / kPi};
}

Vec3 sphere_normal_from_st(TextureCoordinates st) {
  const double longitude = (st.s - 0.5) * 2.0 * kPi;
  const double latitude = (st.t - 0.5) * kPi;
  return {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
          std::cos(longitude) * std::cos(latitude)};
}

// The sky is a sphere seen from inside: its longitude 0 lies along -z, and east is to the right there, too.
TextureCoordinates st_from_sky_direction(const Vec3& d) {
  return st_from_sphere_normal({d.x, d.y, -d.z});
}

Vec3 sky_direction_from_st(TextureCoordinates st) {
  const Vec3 normal = sphere_normal_from_st(st);
  return {normal.x, normal.y, -normal.z};
}

SurfaceHit meet(const Surface& surface, const Camera& camera, FilmPosition film, const RayPath& path) {
  if (const auto* sphere = std::get_if<Sphere>(&surface)) return meet_sphere(*sphere, path);
  if (path.captured) return {Outcome::Captured, {0, 0}, kInfinity};
  const Vec3& last = path.segments.back().direction;
  if (std::holds_alternative<LatLong>(surface)) {
    return {Outcome::Hit, st_from_sky_direction(camera.axes.parent_from_local(last)), kInfinity};
  }
  return meet_plate(camera, film, path.segments.front().direction, last);
}

Surface camera_from_world(const Camera& camera, const Surface& surface) {
  const auto* sphere = std::get_if<Sphere>(&surface);
  if (!sphere) return surface;
  return Sphere{camera.axes.local_from_parent(sphere->centre - camera.position), sphere->radius,
                local_from_parent(camera.axes, sphere->axes)};
}

}  // namespace lensplane
