// SPDX-License-Identifier: Apache-2.0
//
// The perspective projection: film positions are slopes, scaled.

#include "src/projection_kinds.h"

namespace lensplane::perspective {

FilmRay ray(const Camera& camera, FilmPosition film) {
  const double slope = slope_per_pixel(camera);
  const auto [a, b] = slopes_from_pixel(camera, film, slope);
  const double scale = 1.0 / std::sqrt(a * a + b * b + 1.0);
  const double by_slope = slope * scale * scale * scale;
  return {Vec3(a * scale, b * scale, -scale), Vec3(1.0 + b * b, -a * b, a) * by_slope,
          Vec3(a * b, -1.0 - a * a, -b) * by_slope};
}

std::optional<FilmSpot> spot(const Camera& camera, const Vec3& direction) {
  if (!(direction.z < 0)) return std::nullopt;
  const double depth = -direction.z;
  const Slopes slopes{direction.x / depth, direction.y / depth};
  const double pixels = 1.0 / (depth * slope_per_pixel(camera));
  return FilmSpot{pixel_from_slopes(camera, slopes), Vec3(1, 0, slopes.right) * pixels,
                  Vec3(0, -1, -slopes.up) * pixels};
}

std::optional<FilmStep> step(const Camera& camera, FilmPosition film, const Vec3& first, const Vec3& last) {
  if (!(first.z < 0 && last.z < 0)) return std::nullopt;
  // The difference of the slopes, x_l/z_l - x_f/z_f, in terms of the difference of the directions.
  const Vec3 change = last - first;
  const double pixels = 1.0 / (-last.z * slope_per_pixel(camera));
  const double right = (change.x - first.x / first.z * change.z) * pixels;
  const double up = (change.y - first.y / first.z * change.z) * pixels;
  return FilmStep{{film.x + right, film.y - up}};
}

}  // namespace lensplane::perspective
