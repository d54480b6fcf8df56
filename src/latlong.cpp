// SPDX-License-Identifier: Apache-2.0
//
// The lat-long projection: film positions are longitude and latitude, scaled.

#include "src/constants.h"
#include "src/projection_kinds.h"

namespace lensplane::latlong {
namespace {

double radians_across(const Camera& camera) {
  return 2.0 * kPi / camera.width;
}

double radians_down(const Camera& camera) {
  return kPi / camera.height;
}

double latitude_of(const Camera& camera, FilmPosition film) {
  return (0.5 - film.y / camera.height) * kPi;
}

double wrapped(const Camera& camera, double x) {
  const double inside = x - camera.width * std::floor(x / camera.width);
  return inside < camera.width ? inside : 0.0;  // a tiny negative x rounds up to the width
}

}  // namespace

FilmRay ray(const Camera& camera, FilmPosition film) {
  const double longitude = (film.x / camera.width - 0.5) * 2.0 * kPi;
  const double latitude = latitude_of(camera, film);
  const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
  const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
  return {Vec3(sin_lon * cos_lat, sin_lat, -cos_lon * cos_lat),
          Vec3(cos_lon * cos_lat, 0, sin_lon * cos_lat) * radians_across(camera),
          Vec3(sin_lon * sin_lat, -cos_lat, -cos_lon * sin_lat) * radians_down(camera)};
}

std::optional<FilmSpot> spot(const Camera& camera, const Vec3& direction) {
  const double across = std::hypot(direction.x, direction.z), up = direction.y;
  if (across == 0 && up == 0) return std::nullopt;
  const double film_y = (0.5 - std::atan2(up, across) / kPi) * camera.height;
  if (across <= kOnAxis * std::abs(up)) return FilmSpot{{camera.width / 2.0, film_y}, Vec3(0), Vec3(0)};
  const double film_x = (0.5 + std::atan2(direction.x, -direction.z) / (2.0 * kPi)) * camera.width;
  const double x = direction.x / across, z = direction.z / across;
  const double length2 = across * across + up * up;
  return FilmSpot{{wrapped(camera, film_x), film_y},
                  Vec3(-z, 0, x) / (across * radians_across(camera)),
                  Vec3(up * x, -across, up * z) / (length2 * radians_down(camera))};
}

std::optional<FilmStep> step(const Camera& camera, FilmPosition film, const Vec3& first, const Vec3& last) {
  if (first == Vec3(0) || last == Vec3(0)) return std::nullopt;
  const double y_sense = std::cos(latitude_of(camera, film)) < 0 ? -1.0 : 1.0;
  if (first == last) return FilmStep{film, y_sense};
  const Vec3 change = last - first;
  const Vec2 flat(-first.z, first.x), flat_change(-change.z, change.x);
  const double east = turn(flat, flat_change);
  const double north = turn({flat.length(), first.y}, {growth(flat, flat_change), change.y});
  return FilmStep{{wrapped(camera, film.x + east / radians_across(camera)),
                   film.y - y_sense * north / radians_down(camera)},
                  y_sense};
}

}  // namespace lensplane::latlong
