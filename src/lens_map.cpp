// SPDX-License-Identifier: Apache-2.0

#include "src/lens_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "src/map_channels.h"

namespace lensplane {
namespace {

/// A square of the film, as the plan's tiles cut it, in rows and columns of the overscanned film.
struct Tile {
  int left, top, right, bottom;
};

/// The pixel centres of as many rows from `top` as fit. What reaches beyond the tile repeats its last row and
/// is not used; beyond the last whole row its first pixel.
void place_rays(const Tile& tile, int top, int overscan, TraceBatch& batch) {
  const int width = tile.right - tile.left;
  int i = 0;
  for (int row = top; i + width <= kBatchSize; ++row) {
    const double y = std::min(row, tile.bottom - 1) - overscan + 0.5;
    const double x = tile.left - overscan + 0.5;
    for (int column = 0; column < width; ++column, ++i) {
      batch.x[i] = x + column;
      batch.y[i] = y;
    }
  }
  for (; i < kBatchSize; ++i) batch.x[i] = batch.x[0], batch.y[i] = batch.y[0];
}

/// Traces a tile by batches of as many of its rows as fit, and stores it in maps that begin at row `origin`.
void trace_tile(const Tracer& tracer, const Tile& tile, int origin, TraceBatch& batch,
                std::vector<LensMap>& maps) {
  const int overscan = tracer.camera().overscan;
  const int width = tile.right - tile.left;
  const int deep = kBatchSize / width;
  for (int top = tile.top; top < tile.bottom; top += deep) {
    place_rays(tile, top, overscan, batch);
    tracer.trace(batch);
    for (int row = top; row < std::min(top + deep, tile.bottom); ++row) {
      for (std::size_t k = 0; k < maps.size(); ++k) {
        const std::size_t at =
            static_cast<std::size_t>(row - origin) * static_cast<std::size_t>(maps[k].width) +
            static_cast<std::size_t>(tile.left);
        store(batch.surfaces[k], (row - top) * width, width, at, maps[k]);
      }
    }
  }
}

}  // namespace

const Pass* pass_of(const LensMap& map, std::string_view channel) {
  const auto pass = std::find_if(map.passes.begin(), map.passes.end(),
                                 [channel](const Pass& p) { return p.channel == channel; });
  return pass == map.passes.end() ? nullptr : &*pass;
}

std::vector<LensMap> trace_maps(const Tracer& tracer) {
  return trace_maps(tracer, {0, tracer.camera().full_height()});
}

std::vector<LensMap> trace_maps(const Tracer& tracer, RowRange rows, std::vector<LensMap> maps, int above) {
  const int width = tracer.camera().full_width();
  const int size = tracer.plan().tiles.size;
  maps.resize(tracer.surfaces().size());
  for (LensMap& map : maps) make_room(width, above + rows.end - rows.begin, tracer.plan().effects, map);
  const int columns = (width + size - 1) / size;
  const int first = rows.begin / size;
  const int last = (rows.end + size - 1) / size;
  tbb::parallel_for(tbb::blocked_range<int>(0, columns * (last - first)),
                    [&](const tbb::blocked_range<int>& range) {
                      TraceBatch batch = tracer.make_batch();
                      for (int i = range.begin(); i != range.end(); ++i) {
                        const int left = i % columns * size;
                        const int top = (first + i / columns) * size;
                        const Tile tile{left, std::max(top, rows.begin), std::min(left + size, width),
                                        std::min(top + size, rows.end)};
                        trace_tile(tracer, tile, rows.begin - above, batch, maps);
                      }
                    });
  return maps;
}

}  // namespace lensplane
