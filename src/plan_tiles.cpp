// SPDX-License-Identifier: Apache-2.0

#include "src/plan_tiles.h"

#include <algorithm>
#include <cmath>

namespace lensplane {

TileLevels tiles_of(const Camera& camera) {
  TileLevels tiles;
  tiles.columns = (camera.full_width() + tiles.size - 1) / tiles.size;
  tiles.rows = (camera.full_height() + tiles.size - 1) / tiles.size;
  return tiles;
}

std::size_t tile_at(const TileLevels& tiles, const Camera& camera, FilmPosition film) {
  const auto tile = [&](double position, int count) {
    const double index = std::floor((position + camera.overscan) / tiles.size);
    return static_cast<std::size_t>(std::clamp(index, 0.0, count - 1.0));
  };
  return tile(film.y, tiles.rows) * static_cast<std::size_t>(tiles.columns) + tile(film.x, tiles.columns);
}

std::vector<double> shares_of(const TileLevels& tiles, const Camera& camera,
                              const std::vector<std::uint8_t>& kinds, std::size_t count) {
  const std::int64_t width = camera.full_width(), height = camera.full_height();
  std::vector<std::int64_t> pixels(count, 0);
  for (int row = 0; row < tiles.rows; ++row) {
    for (int column = 0; column < tiles.columns; ++column) {
      const std::int64_t across = std::min<std::int64_t>(tiles.size, width - column * tiles.size);
      const std::int64_t down = std::min<std::int64_t>(tiles.size, height - row * tiles.size);
      pixels[kinds[static_cast<std::size_t>(row * tiles.columns + column)]] += across * down;
    }
  }
  std::vector<double> shares;
  for (const std::int64_t part : pixels)
    shares.push_back(static_cast<double>(part) / static_cast<double>(width * height));
  return shares;
}

}  // namespace lensplane
