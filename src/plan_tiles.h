// SPDX-License-Identifier: Apache-2.0
//
// The tiles of the film: what the plan chooses for each, and which tile a film position lies in.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/projection.h"

namespace lensplane {

/// Square tiles of the film, overscan included, from its upper left; each has its laws.
struct TileLevels {
  int size = 64;  // pixels
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> level;  // index into Plan::recipes, row by row; empty: the last recipe everywhere
  // By `planes` where there are masses and bodies, row by row; otherwise empty.
  std::vector<std::uint8_t> curved{};  // 1 where bodies are met by curved rays
  std::vector<double> chords_px{};     // by how much chords would misplace bodies at most
};

/// The tiles of a camera's film, nothing chosen yet.
TileLevels tiles_of(const Camera& camera);

/// The number of the tile in which a film position lies; beyond the film the nearest.
std::size_t tile_at(const TileLevels& tiles, const Camera& camera, FilmPosition film);

/// The share of the film, overscan included, of each of `count` kinds of tiles. `kinds`: row by row, below
/// `count`.
std::vector<double> shares_of(const TileLevels& tiles, const Camera& camera,
                              const std::vector<std::uint8_t>& kinds, std::size_t count);

}  // namespace lensplane
