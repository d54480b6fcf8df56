// SPDX-License-Identifier: Apache-2.0

#include "src/film_area.h"

#include <cmath>

namespace lensplane {

FilmArea film_area(const Camera& camera, double margin) {
  const double beyond = camera.overscan + margin;
  return {-beyond, -beyond, camera.width + beyond, camera.height + beyond};
}

std::vector<FilmPosition> films_of_direction(const Camera& camera, const FilmArea& area,
                                             const Vec3& direction) {
  const auto spot = film_from_direction<double>(camera, direction);
  if (!spot) return {};
  const FilmPosition film{spot->x, spot->y};
  std::vector<FilmPosition> films;
  if (camera.projection != Projection::LatLong) {
    if (area.contains(film) && sees(camera, film)) films.push_back(film);
    return films;
  }
  // Beyond a pole the film shows the other side, upside down.
  const double width = camera.width, height = camera.height;
  for (const FilmPosition first : {film, FilmPosition{film.x + width / 2.0, -film.y},
                                   FilmPosition{film.x + width / 2.0, 2.0 * height - film.y}}) {
    const double turns = std::ceil((area.left - first.x) / width);
    for (double x = first.x + turns * width; x < area.right; x += width) {
      if (area.contains({x, first.y})) films.push_back({x, first.y});
    }
  }
  return films;
}

}  // namespace lensplane
