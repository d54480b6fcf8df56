// SPDX-License-Identifier: Apache-2.0

#include "src/body_image.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lensplane {
namespace {

/// The film shift that moves what is seen by about (u, v), the smaller one where many do.
FilmPosition damped_shift(const FilmJacobian& j, double u, double v) {
  static constexpr double kMostStretched = 30.0;  // times as far as in the other direction
  const double damping = stretching_of(j).most / kMostStretched;
  const double xx = j.u_x * j.u_x + j.v_x * j.v_x + damping * damping,
               yy = j.u_y * j.u_y + j.v_y * j.v_y + damping * damping, xy = j.u_x * j.u_y + j.v_x * j.v_y;
  const double x = j.u_x * u + j.v_x * v, y = j.u_y * u + j.v_y * v, det = xx * yy - xy * xy;
  if (!(det > 0.0)) return {0, 0};
  return {(yy * x - xy * y) / det, (xx * y - xy * x) / det};
}

/// The smallest film shift that leads to the distance `radius` from the origin, where (u, v) is seen without
/// it: with Lagrange's multiplier m, along each principal axis, (u, v) grows by 1/(1 - m stretch^2).
FilmPosition shift_to_radius(const FilmJacobian& j, double u, double v, double radius) {
  static constexpr int kHalvings = 60;
  static constexpr double kFarthest = 1e6;
  const Stretching stretching = stretching_of(j);
  const double most = stretching.most, least = stretching.least, ratio = (least / most) * (least / most);
  // The image's principal axes, from those of the film.
  const double along_u = (j.u_x * stretching.x + j.u_y * stretching.y) / most,
               along_v = (j.v_x * stretching.x + j.v_y * stretching.y) / most;
  const double sign = j.determinant() < 0.0 ? -1.0 : 1.0;
  const double major = along_u * u + along_v * v, minor = sign * (along_u * v - along_v * u);
  const bool inwards = std::hypot(u, v) > radius;
  double low = inwards ? -kFarthest : 0.0, high = inwards ? 0.0 : 1.0;  // of m most^2
  for (int n = 0; n < kHalvings; ++n) {
    // Far out in equal factors.
    const double middle = low < -1.0 ? -std::sqrt(low * std::min(high, -1e-3)) : (low + high) / 2;
    const double there = std::hypot(major / (1.0 - middle), minor / (1.0 - middle * ratio));
    (there > radius ? high : low) = middle;
  }
  const double along = major * low / (1.0 - low) / most,
               across = minor * low * least / (1.0 - low * ratio) / (most * most);
  return {stretching.x * along - stretching.y * across, stretching.y * along + stretching.x * across};
}

FilmJacobian jacobian_of(const TangentPlane& plane, const DualVec3& v) {
  const Vec3 x = derivative_by_x(v), y = derivative_by_y(v);
  return {plane.u.dot(x), plane.u.dot(y), plane.v.dot(x), plane.v.dot(y)};
}

/// From a point to the light where it is nearest.
DualVec3 miss_of(const Vec3& point, const LightLine& light) {
  const DualVec3 way = light.start - constant<Dual>(point);
  return way - light.direction * way.dot(light.direction);
}

bool is_ahead(const Vec3& point, double size, const LightLine& light) {
  return (point - value_of(light.start)).dot(value_of(light.direction)) > -size;
}

/// A vector across the light.
struct PlaneVector {
  double u, v;
};
PlaneVector on_plane(const TangentPlane& plane, const Vec3& v) {
  return {plane.u.dot(v), plane.v.dot(v)};
}

std::optional<BodyImage> image_of(const Sphere& sphere, const LightLine& light, FilmPosition at) {
  const TangentPlane plane = tangent_plane(value_of(light.direction));
  const DualVec3 miss = miss_of(sphere.centre, light);
  const auto [u, v] = on_plane(plane, value_of(miss));
  return BodyImage{at, u, v, jacobian_of(plane, miss), 0.0, sphere.radius};
}

std::optional<BodyImage> image_of(const Ring& ring, const LightLine& light, FilmPosition at) {
  const DualVec3 normal = constant<Dual>(ring.axes.y), centre = constant<Dual>(ring.centre);
  const Dual rate = normal.dot(light.direction);
  const Dual way = normal.dot(centre - light.start) * reciprocal(rate);
  if (!(value_of(way) > 0.0) || value_of(rate) == 0.0) return std::nullopt;
  const DualVec3 point = light.start + light.direction * way - centre;
  const TangentPlane plane{ring.axes.z, ring.axes.x};
  const auto [u, v] = on_plane(plane, value_of(point));
  return BodyImage{at, u, v, jacobian_of(plane, point), ring.inner, ring.outer};
}

/// The smallest film shift onto a ring that is seen well from above, near where the light goes through its
/// plane.
std::optional<FilmPosition> shift_onto(const Ring& ring, const LightLine& light, double tilt) {
  static constexpr double kSteep = 0.1, kNear = 4.0;
  if (tilt < kSteep) return std::nullopt;
  const auto image = image_of(ring, light, {0, 0});
  const double radius = image ? std::hypot(image->u, image->v) : 0.0;
  if (!(radius > 0.0 && radius < kNear * ring.outer)) return std::nullopt;
  if (radius >= ring.inner && radius <= ring.outer) return FilmPosition{0, 0};
  const double inset = 0.1 * (ring.outer - ring.inner);  // safely on it
  const double wanted = std::clamp(radius, ring.inner + inset, ring.outer - inset);
  return shift_to_radius(image->by_film, image->u, image->v, wanted);
}

std::optional<Approach> approach_to(const Sphere& sphere, const LightLine& light) {
  if (!is_ahead(sphere.centre, sphere.radius, light)) return std::nullopt;
  const TangentPlane plane = tangent_plane(value_of(light.direction));
  const DualVec3 miss = miss_of(sphere.centre, light);
  const FilmJacobian j = jacobian_of(plane, miss);
  const double largest = stretching_of(j).most, distance = length(value_of(miss));
  if (!(largest > 0.0)) return std::nullopt;
  const double thickness = 2.0 * sphere.radius / largest, wanted = 0.9 * sphere.radius;  // safely on it
  const auto [u, v] = on_plane(plane, value_of(miss));
  return Approach{std::max(0.0, distance - sphere.radius) / largest, thickness, thickness,
                  distance > sphere.radius ? shift_to_radius(j, u, v, wanted) : FilmPosition{0, 0}};
}

std::optional<Approach> approach_to(const Ring& ring, const LightLine& light, double turn) {
  if (!is_ahead(ring.centre, ring.outer, light)) return std::nullopt;
  const Vec3 start = value_of(light.start), direction = value_of(light.direction);
  const Vec3 nearest = nearest_point(ring, start, direction, std::numeric_limits<double>::infinity()).of_body;
  const TangentPlane plane = tangent_plane(direction);
  const DualVec3 miss = miss_of(nearest, light);
  const FilmJacobian j = jacobian_of(plane, miss);
  const double largest = stretching_of(j).most, tilt = std::abs(ring.axes.y.dot(direction));
  if (!(largest > 0.0)) return std::nullopt;
  // Across the ring, along a tangent of it, as the map's adjugate takes it to the film.
  const Vec3 out =
      nearest_on_ring({ring.centre, ring.axes, ring.outer, 2.0 * ring.outer}, nearest) - ring.centre;
  const PlaneVector along = on_plane(plane, ring.axes.y.cross(out / ring.outer));
  const double tangent = std::hypot(j.v_y * along.u - j.u_y * along.v, -j.v_x * along.u + j.u_x * along.v);
  const double across = (ring.outer - ring.inner) * tilt / tangent,
               through = 2.0 * ring.outer * tilt / largest;
  const Vec3 off = value_of(miss);
  return Approach{
      length(off) / largest, std::min(across, through),
      (ring.outer - ring.inner) * std::max(0.0, tilt - turn) / largest,
      shift_onto(ring, light, tilt).value_or(damped_shift(j, -plane.u.dot(off), -plane.v.dot(off)))};
}

PlaneVector seen_at(const BodyImage& image, FilmPosition film) {
  const double x = film.x - image.at.x, y = film.y - image.at.y;
  const FilmJacobian& j = image.by_film;
  return {image.u + j.u_x * x + j.u_y * y, image.v + j.v_x * x + j.v_y * y};
}

}  // namespace

Stretching stretching_of(const FilmJacobian& map) {
  const double xx = map.u_x * map.u_x + map.v_x * map.v_x, yy = map.u_y * map.u_y + map.v_y * map.v_y,
               xy = map.u_x * map.u_y + map.v_x * map.v_y;
  const double mean = (xx + yy) / 2, half = (xx - yy) / 2;
  const double most = std::sqrt(mean + std::hypot(half, xy)), turn = 0.5 * std::atan2(xy, half);
  return {most, most > 0.0 ? std::abs(map.determinant()) / most : 0.0, std::cos(turn), std::sin(turn)};
}

std::optional<Approach> approach(const Surface& body, const LightLine& light, double turn) {
  if (const auto* sphere = std::get_if<Sphere>(&body)) return approach_to(*sphere, light);
  return approach_to(std::get<Ring>(body), light, turn);
}

std::optional<BodyImage> body_image(const Surface& body, const LightLine& light, FilmPosition at) {
  if (const auto* sphere = std::get_if<Sphere>(&body)) return image_of(*sphere, light, at);
  return image_of(std::get<Ring>(body), light, at);
}

bool BodyImage::holds(FilmPosition film, double slack) const {
  const auto [x, y] = seen_at(*this, film);
  const double radius = std::hypot(x, y), more = slack * stretching_of(by_film).most;
  return radius >= inner - more && radius <= outer + more;
}

double apart(const BodyImage& a, const BodyImage& b, FilmPosition film) {
  const PlaneVector of_a = seen_at(a, film), of_b = seen_at(b, film);
  const FilmPosition shift = damped_shift(b.by_film, of_a.u - of_b.u, of_a.v - of_b.v);
  return std::hypot(shift.x, shift.y);
}

}  // namespace lensplane
