// SPDX-License-Identifier: Apache-2.0

#include "src/surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "src/arrival_time.h"
#include "src/bodies.h"
#include "src/constants.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Number>
Vector<Number> parent_from_local(const Basis& axes, const Vector<Number>& v) {
  return constant<Number>(axes.x) * v.x + constant<Number>(axes.y) * v.y + constant<Number>(axes.z) * v.z;
}

/// Angles at a pole have no derivatives.
double angle(double y, double x) {
  return std::atan2(y, x);
}
Dual angle(const Dual& y, const Dual& x) {
  return x.v == 0.0 && y.v == 0.0 ? Dual(std::atan2(y.v, x.v)) : atan2(y, x);
}

/// The parallelogram that the derivatives of `v` span, as seen along `axis`.
double spanned(const Vec3& axis, const DualVec3& v) {
  return axis.dot(derivative_by_x(v).cross(derivative_by_y(v)));
}

double magnification_of(double seen, double there) {
  const double mu = seen / there;
  if (std::isnan(mu)) return 0.0;
  return std::clamp(mu, -kLargestMagnification, kLargestMagnification);
}

}  // namespace

template <class Number>
TexturePoint<Number> st_from_sphere_normal(const Vector<Number>& n) {
  const Number longitude = angle(n.x, n.z);
  const Number latitude = angle(n.y, length(Vector<Number>(n.x, n.z, Number(0.0))));
  return {0.5 + longitude * (1.0 / (2.0 * kPi)), 0.5 + latitude * (1.0 / kPi)};
}

Vec3 sphere_normal_from_st(TextureCoordinates st) {
  const double longitude = (st.s - 0.5) * 2.0 * kPi;
  const double latitude = (st.t - 0.5) * kPi;
  return {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
          std::cos(longitude) * std::cos(latitude)};
}

template <class Number>
TexturePoint<Number> st_from_ring_point(const Ring& ring, const Vector<Number>& p) {
  const Number radius = length(Vector<Number>(p.x, p.z, Number(0.0)));
  return {(radius - Number(ring.inner)) * (1.0 / (ring.outer - ring.inner)),
          0.5 + angle(p.x, p.z) * (1.0 / (2.0 * kPi))};
}

Vec3 ring_point_from_st(const Ring& ring, TextureCoordinates st) {
  const double radius = ring.inner + st.s * (ring.outer - ring.inner);
  const double angle = (st.t - 0.5) * 2.0 * kPi;
  return ring.centre + ring.axes.parent_from_local({radius * std::sin(angle), 0.0, radius * std::cos(angle)});
}

// The sky is a sphere seen from inside: its longitude 0 lies along -z, and east is to the right there, too.
template <class Number>
TexturePoint<Number> st_from_sky_direction(const Vector<Number>& d) {
  return st_from_sphere_normal(Vector<Number>(d.x, d.y, -d.z));
}

Vec3 sky_direction_from_st(TextureCoordinates st) {
  const Vec3 normal = sphere_normal_from_st(st);
  return {normal.x, normal.y, -normal.z};
}

double magnification_at_infinity(const DualVec3& first, const DualVec3& last) {
  return magnification_of(spanned(value_of(first), first), spanned(value_of(last), last));
}

double magnification_of_point(const DualVec3& first, const DualVec3& point, const Vec3& normal) {
  const Vec3 p = value_of(point);
  const double distance = length(p);
  const Vec3 sight = p / distance;
  const double there = spanned(sight, point) / (distance * distance);
  const bool from_inside = sight.dot(normal) > 0.0;  // its back: without lensing it would be seen mirrored
  return magnification_of(spanned(value_of(first), first), from_inside ? -there : there);
}

template <class Number>
SurfaceHit<Number> meet_plate(const Camera& camera, FilmPosition film, const Vector<Number>& first,
                              const Vector<Number>& last) {
  SurfaceHit<Number> hit;
  hit.outcome = Outcome::Behind;
  hit.distance = kInfinity;
  hit.direction = value_of(last);
  const auto on_film = film_moved(camera, film, first, last);
  if (!on_film) return hit;
  const TexturePoint<Number> st{on_film->x / double(camera.width), 1.0 - on_film->y / double(camera.height)};
  if (!(std::abs(value_of(st.s)) <= kPlateLimit && std::abs(value_of(st.t)) <= kPlateLimit)) return hit;
  hit.outcome = Outcome::Hit;
  hit.st = st;
  if constexpr (std::is_same_v<Number, Dual>) hit.magnification = magnification_at_infinity(first, last);
  return hit;
}

template <class Number>
SurfaceHit<Number> meet_sky(const Camera& camera, const Vector<Number>& first, const Vector<Number>& last) {
  SurfaceHit<Number> hit;
  hit.outcome = Outcome::Hit;
  hit.distance = kInfinity;
  hit.direction = value_of(last);
  hit.st = st_from_sky_direction(parent_from_local(camera.axes, last));
  if constexpr (std::is_same_v<Number, Dual>) hit.magnification = magnification_at_infinity(first, last);
  return hit;
}

template <class Number>
SurfaceHit<Number> meet(const Surface& surface, const Camera& camera, FilmPosition film,
                        const RayPath<Number>& path, const Deflectors* finite) {
  if (is_body(surface)) return meet_body(surface, camera, film, path, finite);
  const Vector<Number>& first = path.segments.front().direction;
  if (is_bent(surface)) return meet_plate(camera, film, first, first);
  const RaySegment<Number>& end = path.segments.back();
  SurfaceHit<Number> hit;
  if (path.ended()) {
    hit.outcome = path.captured ? Outcome::Captured : Outcome::Unresolved;
    hit.distance = kInfinity;
    hit.direction = value_of(end.direction);
  } else {
    hit = std::holds_alternative<LatLong>(surface) ? meet_sky(camera, first, end.direction)
                                                   : meet_plate(camera, film, first, end.direction);
    hit.delay = excess_over_wave_front(excess_until(path, path.segments.size() - 1)) +
                shapiro_delay_from_infinity(path);
  }
  hit.bends = path.bends;
  return hit;
}

Surface camera_from_world(const Camera& camera, const Surface& surface) {
  const auto placed = [&camera](auto body) {
    body.centre = camera.axes.local_from_parent(body.centre - camera.position);
    body.axes = local_from_parent(camera.axes, body.axes);
    return Surface(body);
  };
  if (const auto* sphere = std::get_if<Sphere>(&surface)) return placed(*sphere);
  if (const auto* ring = std::get_if<Ring>(&surface)) return placed(*ring);
  return surface;  // in camera axes anyway
}

template TexturePoint<double> st_from_sky_direction(const Vec3&);
template TexturePoint<Dual> st_from_sky_direction(const DualVec3&);
template TexturePoint<double> st_from_sphere_normal(const Vec3&);
template TexturePoint<Dual> st_from_sphere_normal(const DualVec3&);
template TexturePoint<double> st_from_ring_point(const Ring&, const Vec3&);
template TexturePoint<Dual> st_from_ring_point(const Ring&, const DualVec3&);
template SurfaceHit<double> meet_plate(const Camera&, FilmPosition, const Vec3&, const Vec3&);
template SurfaceHit<Dual> meet_plate(const Camera&, FilmPosition, const DualVec3&, const DualVec3&);
template SurfaceHit<double> meet_sky(const Camera&, const Vec3&, const Vec3&);
template SurfaceHit<Dual> meet_sky(const Camera&, const DualVec3&, const DualVec3&);
template SurfaceHit<double> meet(const Surface&, const Camera&, FilmPosition, const RayPath<double>&,
                                 const Deflectors*);
template SurfaceHit<Dual> meet(const Surface&, const Camera&, FilmPosition, const RayPath<Dual>&,
                               const Deflectors*);

}  // namespace lensplane
