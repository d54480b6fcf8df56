// SPDX-License-Identifier: Apache-2.0
//
// Where maps have edges: pixels whose centres see a surface that a neighbour's does not, or the other way
// round; with a pass for the shadow, that too. Neighbours just beyond the film count: they are traced for
// this.

#pragma once

#include <cstdint>
#include <vector>

#include "src/lens_map.h"

namespace lensplane {

/// By the rows and columns of maps.
struct MapPixel {
  int row, column;
};

inline std::size_t place_in(const LensMap& map, int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
         static_cast<std::size_t>(column);
}

struct MapEdges {
  std::vector<std::vector<int>> columns;  // by row, ascending: the pixels that hold an edge of any surface
  std::int64_t rays = 0;                  // that were traced to find them
};

/// Of maps that hold what trace_maps() has found at `rows`; at least one. Neighbours in other rows of the
/// film are left out of account. Runs in parallel.
MapEdges find_edges(const Tracer& tracer, RowRange rows, const std::vector<LensMap>& maps);

}  // namespace lensplane
