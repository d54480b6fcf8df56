// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/worst_place.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace lensplane {

std::string place_in_words(const Shot& shot, const Scene& scene, FilmPosition film) {
  const Camera& camera = scene.camera;
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t lens = 0;
  for (std::size_t i = 0; i < scene.lenses.size(); ++i) {
    if (!(scene.lenses[i].m > 0)) continue;
    const Vec3 direction = camera.axes.local_from_parent(scene.lenses[i].position - camera.position);
    const auto at = film_from_direction<double>(camera, direction);
    if (!at) continue;
    const double away = std::hypot(at->x - film.x, at->y - film.y);
    if (away < nearest) nearest = away, lens = i;
  }
  const std::string place = fmt::format("({}, {})", film.x, film.y);
  if (!(nearest < camera.width + camera.height)) return place;
  return fmt::format("{}, {:.3g} px from {}", place, nearest, shot.lenses[lens].name);
}

}  // namespace lensplane
