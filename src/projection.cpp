// SPDX-License-Identifier: Apache-2.0

#include "src/projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "src/constants.h"
#include "src/projection_kinds.h"

namespace lensplane {
namespace {

struct Kind {
  FilmRay (*ray)(const Camera&, FilmPosition);
  std::optional<FilmSpot> (*spot)(const Camera&, const Vec3&);
  std::optional<FilmStep> (*step)(const Camera&, FilmPosition, const Vec3&, const Vec3&);
};

// In the order of Projection.
constexpr std::array<Kind, 3> kKinds = {
    Kind{perspective::ray, perspective::spot, perspective::step},
    Kind{latlong::ray, latlong::spot, latlong::step},
    Kind{fisheye::ray, fisheye::spot, fisheye::step},
};

const Kind& kind_of(const Camera& camera) {
  return kKinds[static_cast<std::size_t>(camera.projection)];
}

/// The derivatives of film x and y, given how the direction changes.
struct SpotDerivatives {
  FilmPosition by_x, by_y;
};

SpotDerivatives derivatives_of(const FilmSpot& spot, const DualVec3& direction) {
  const Vec3 by_x = derivative_by_x(direction), by_y = derivative_by_y(direction);
  return {{spot.x_gradient.dot(by_x), spot.y_gradient.dot(by_x)},
          {spot.x_gradient.dot(by_y), spot.y_gradient.dot(by_y)}};
}

}  // namespace

bool sees(const Camera& camera, FilmPosition film) {
  if (camera.projection != Projection::Fisheye) return true;
  const double right = film.x - camera.width / 2.0, down = film.y - camera.height / 2.0;
  const double radius = std::min(camera.width, camera.height) / 2.0;
  return right * right + down * down <= radius * radius;
}

double pixel_angle(const Camera& camera) {
  switch (camera.projection) {
    case Projection::LatLong:
      return 2.0 * kPi / camera.width;
    case Projection::Fisheye:
      return camera.fov_rad / std::min(camera.width, camera.height);
    case Projection::Perspective:
      break;
  }
  return slope_per_pixel(camera);
}

template <class Number>
Vector<Number> direction_from_film(const Camera& camera, FilmPosition film) {
  const FilmRay ray = kind_of(camera).ray(camera, film);
  if constexpr (std::is_same_v<Number, Dual>) {
    return dual_vector(ray.direction, ray.by_x, ray.by_y);
  } else {
    return ray.direction;
  }
}

template <class Number>
std::optional<FilmPoint<Number>> film_from_direction(const Camera& camera, const Vector<Number>& direction) {
  const auto spot = kind_of(camera).spot(camera, value_of(direction));
  if (!spot) return std::nullopt;
  if constexpr (std::is_same_v<Number, Dual>) {
    const auto [by_x, by_y] = derivatives_of(*spot, direction);
    return FilmPoint<Dual>{{spot->film.x, by_x.x, by_y.x}, {spot->film.y, by_x.y, by_y.y}};
  } else {
    return FilmPoint<double>{spot->film.x, spot->film.y};
  }
}

template <class Number>
std::optional<FilmPoint<Number>> film_moved(const Camera& camera, FilmPosition film,
                                            const Vector<Number>& first, const Vector<Number>& last) {
  const Kind& kind = kind_of(camera);
  const auto step = kind.step(camera, film, value_of(first), value_of(last));
  if (!step) return std::nullopt;
  if constexpr (std::is_same_v<Number, Dual>) {
    // A step has both spots.
    const SpotDerivatives from = derivatives_of(*kind.spot(camera, value_of(first)), first);
    const SpotDerivatives to = derivatives_of(*kind.spot(camera, value_of(last)), last);
    return FilmPoint<Dual>{{step->film.x, 1.0 + (to.by_x.x - from.by_x.x), to.by_y.x - from.by_y.x},
                           {step->film.y, step->y_sense * (to.by_x.y - from.by_x.y),
                            1.0 + step->y_sense * (to.by_y.y - from.by_y.y)}};
  } else {
    return FilmPoint<double>{step->film.x, step->film.y};
  }
}

template Vector<double> direction_from_film(const Camera&, FilmPosition);
template Vector<Dual> direction_from_film(const Camera&, FilmPosition);
template std::optional<FilmPoint<double>> film_from_direction(const Camera&, const Vector<double>&);
template std::optional<FilmPoint<Dual>> film_from_direction(const Camera&, const Vector<Dual>&);
template std::optional<FilmPoint<double>> film_moved(const Camera&, FilmPosition, const Vector<double>&,
                                                     const Vector<double>&);
template std::optional<FilmPoint<Dual>> film_moved(const Camera&, FilmPosition, const Vector<Dual>&,
                                                   const Vector<Dual>&);

double slope_per_pixel(const Camera& camera) {
  return 2.0 * std::tan(camera.fov_rad / 2.0) / camera.width;
}

Slopes slopes_from_pixel(const Camera& camera, FilmPosition film) {
  return slopes_from_pixel(camera, film, slope_per_pixel(camera));
}

Slopes slopes_from_pixel(const Camera& camera, FilmPosition film, double slope) {
  return {(film.x - camera.width / 2.0) * slope, (camera.height / 2.0 - film.y) * slope};
}

FilmPosition pixel_from_slopes(const Camera& camera, Slopes slopes) {
  const double slope = slope_per_pixel(camera);
  return {camera.width / 2.0 + slopes.right / slope, camera.height / 2.0 - slopes.up / slope};
}

Vec3 direction_from_pixel(const Camera& camera, FilmPosition film) {
  return perspective::ray(camera, film).direction;
}

}  // namespace lensplane
