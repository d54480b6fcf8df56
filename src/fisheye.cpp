// SPDX-License-Identifier: Apache-2.0
//
// The equidistant fisheye projection: film positions are angles from the axis, scaled.
//
// Notation: (right, up) is the film position from the frame's centre in pixels, e the unit vector along it,
// theta the angle of the direction from the axis.

#include <algorithm>

#include "src/projection_kinds.h"

namespace lensplane::fisheye {
namespace {

double radians_per_pixel(const Camera& camera) {
  return camera.fov_rad / std::min(camera.width, camera.height);
}

/// The unit vector along (right, up), `radius` long. In the middle, where there is none, any serves: there
/// the rates along it and across it are the same.
Vec2 along(double right, double up, double radius) {
  return radius > 0 ? Vec2(right, up) / radius : Vec2(1, 0);
}

/// A direction in cylindrical coordinates about the axis.
struct AboutAxis {
  double away;    // from the axis
  double ahead;   // along it
  Vec2 e;         // where away
  double theta;   // angle from the axis
  double spread;  // theta/away: takes (x, y) to radians on the film
};

/// Nothing for straight backwards, which lies everywhere on a circle, and for the zero vector.
std::optional<AboutAxis> about_axis(const Vec3& direction) {
  const double away = std::hypot(direction.x, direction.y), ahead = -direction.z;
  const double theta = std::atan2(away, ahead);
  if (away > kOnAxis * std::abs(ahead))
    return AboutAxis{away, ahead, along(direction.x, direction.y, away), theta, theta / away};
  if (!(ahead > 0)) return std::nullopt;
  return AboutAxis{away, ahead, Vec2(1, 0), theta, 1.0 / ahead};
}

/// The matrix with eigenvalue `outward` along `e` and `across` at right angles to it.
struct Stretch {
  double xx, xy, yy;
};
Stretch stretch(const Vec2& e, double outward, double across) {
  return {outward * e.x * e.x + across * e.y * e.y, (outward - across) * e.x * e.y,
          outward * e.y * e.y + across * e.x * e.x};
}

}  // namespace

FilmRay ray(const Camera& camera, FilmPosition film) {
  const double right = film.x - camera.width / 2.0, up = camera.height / 2.0 - film.y;
  const double radius = std::hypot(right, up);
  const double per_pixel = radians_per_pixel(camera);
  const double theta = per_pixel * radius;
  const Vec2 e = along(right, up, radius);
  const double sine = std::sin(theta), cosine = std::cos(theta);
  const Stretch rate = stretch(e, cosine, theta > 0 ? sine / theta : 1.0);
  return {Vec3(sine * e.x, sine * e.y, -cosine), Vec3(rate.xx, rate.xy, sine * e.x) * per_pixel,
          Vec3(rate.xy, rate.yy, sine * e.y) * -per_pixel};
}

std::optional<FilmSpot> spot(const Camera& camera, const Vec3& direction) {
  const auto about = about_axis(direction);
  if (!about) return std::nullopt;
  const double pixels = 1.0 / radians_per_pixel(camera);
  const double length2 = about->away * about->away + about->ahead * about->ahead;
  const Stretch rate = stretch(about->e, about->ahead / length2, about->spread);
  return FilmSpot{{camera.width / 2.0 + about->spread * direction.x * pixels,
                   camera.height / 2.0 - about->spread * direction.y * pixels},
                  Vec3(rate.xx, rate.xy, direction.x / length2) * pixels,
                  Vec3(rate.xy, rate.yy, direction.y / length2) * -pixels};
}

std::optional<FilmStep> step(const Camera& camera, FilmPosition film, const Vec3& first, const Vec3& last) {
  const auto from = about_axis(first), to = about_axis(last);
  if (!from || !to) return std::nullopt;
  const Vec2 change(last.x - first.x, last.y - first.y);
  const double away = growth({first.x, first.y}, change);
  const double theta = turn({from->ahead, from->away}, {first.z - last.z, away});
  // Away from the axis, theta changes; what the change of (x, y) has besides that is taken to the film.
  const Vec2 shift = (from->e * theta + (change - from->e * away) * to->spread) / radians_per_pixel(camera);
  return FilmStep{{film.x + shift.x, film.y - shift.y}};
}

}  // namespace lensplane::fisheye
