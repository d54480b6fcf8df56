// SPDX-License-Identifier: Apache-2.0

#include "src/projection.h"

#include <cmath>

namespace lensplane {

double slope_per_pixel(const Camera& camera) {
  return 2.0 * std::tan(camera.fov_rad / 2.0) / camera.width;
}

Slopes slopes_from_pixel(const Camera& camera, FilmPosition film) {
  const double slope = slope_per_pixel(camera);
  return {(film.x - camera.width / 2.0) * slope, (camera.height / 2.0 - film.y) * slope};
}

FilmPosition pixel_from_slopes(const Camera& camera, Slopes slopes) {
  const double slope = slope_per_pixel(camera);
  return {camera.width / 2.0 + slopes.right / slope, camera.height / 2.0 - slopes.up / slope};
}

Vec3 direction_from_pixel(const Camera& camera, FilmPosition film) {
  const Slopes slopes = slopes_from_pixel(camera, film);
  const double scale = 1.0 / std::sqrt(slopes.right * slopes.right + slopes.up * slopes.up + 1.0);
  return {slopes.right * scale, slopes.up * scale, -scale};
}

}  // namespace lensplane
