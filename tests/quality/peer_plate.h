// SPDX-License-Identifier: Apache-2.0
//
// What the peers have in common: texels of a plate, within it and beyond its edges, and going through a map.

#pragma once

#include <tbb/parallel_for.h>

#include "pipeline/composite/texel_place.h"
#include "pipeline/image/picture.h"
#include "src/lens_map.h"

namespace lensplane {

/// The texel at any place of a plate, counted from its upper left.
inline Rgba texel_at(const Picture& plate, Wrap edge, int column, int row) {
  const TexelPlace place = place_of(plate, edge, column, row);
  return place.count > 0 ? plate.at(place.column - plate.x, place.row - plate.y) : Rgba{0, 0, 0, 0};
}

/// The picture whose covered pixels are `look(column, row, i)`, i their number in the map, times the
/// coverage. Runs in parallel.
template <class Look>
Picture warped(const LensMap& map, Look look) {
  Picture picture{map.width, map.height, 0, 0, map.width, map.height, {}};
  picture.pixels.assign(map.s.size(), Rgba{0, 0, 0, 0});
  tbb::parallel_for(0, map.height, [&](int row) {
    for (int column = 0; column < map.width; ++column) {
      const auto i = static_cast<std::size_t>(row * map.width + column);
      if (map.valid[i] == 0) continue;
      picture.pixels[i] = look(column, row, i);
      for (float& channel : picture.pixels[i]) channel *= map.valid[i];
    }
  });
  return picture;
}

}  // namespace lensplane
