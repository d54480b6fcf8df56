// SPDX-License-Identifier: Apache-2.0

#include "src/lens_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

namespace lensplane {
namespace {

/// A channel: which effect calls for it, and its value for ray `i`.
struct Channel {
  bool Effects::*effect;
  std::string_view name;
  double (*value)(const SurfaceBatch&, int i);
};

constexpr std::array kChannels = {
    Channel{&Effects::jacobian, "jacobian.ds_dx",
            [](const SurfaceBatch& b, int i) { return b.passes->ds_dx[i]; }},
    Channel{&Effects::jacobian, "jacobian.ds_dy",
            [](const SurfaceBatch& b, int i) { return b.passes->ds_dy[i]; }},
    Channel{&Effects::jacobian, "jacobian.dt_dx",
            [](const SurfaceBatch& b, int i) { return b.passes->dt_dx[i]; }},
    Channel{&Effects::jacobian, "jacobian.dt_dy",
            [](const SurfaceBatch& b, int i) { return b.passes->dt_dy[i]; }},
    Channel{&Effects::magnification, "lensing.magnification",
            [](const SurfaceBatch& b, int i) { return b.passes->magnification[i]; }},
    Channel{&Effects::delay, "lensing.delay",
            [](const SurfaceBatch& b, int i) { return b.passes->delay[i]; }},
    Channel{&Effects::direction, "dir.x", [](const SurfaceBatch& b, int i) { return b.passes->dir_x[i]; }},
    Channel{&Effects::direction, "dir.y", [](const SurfaceBatch& b, int i) { return b.passes->dir_y[i]; }},
    Channel{&Effects::direction, "dir.z", [](const SurfaceBatch& b, int i) { return b.passes->dir_z[i]; }},
    Channel{&Effects::shadow, "lensing.shadow",
            [](const SurfaceBatch& b, int i) { return b.outcome[i] == Outcome::Captured ? 1.0 : 0.0; }},
    Channel{&Effects::bends, "lensing.bends",
            [](const SurfaceBatch& b, int i) { return b.passes->bends[i]; }},
    Channel{&Effects::depth, "depth.z",
            [](const SurfaceBatch& b, int i) { return b.outcome[i] == Outcome::Hit ? b.distance[i] : 0.0; }},
};

/// Stores numbers as floats, finite whatever comes.
LENSPLANE_KERNEL void store(const double* from, int count, float* to) {
  constexpr double kLargest = std::numeric_limits<float>::max();
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const double number = from[i] == from[i] ? from[i] : 0.0;
    const double bounded = number < kLargest ? number : kLargest;
    to[i] = static_cast<float>(bounded > -kLargest ? bounded : -kLargest);
  }
}

void store(const SurfaceBatch& surface, int first, int count, std::size_t at, LensMap& map) {
  store(surface.s + first, count, &map.s[at]);
  store(surface.t + first, count, &map.t[at]);
  const Outcome* outcomes = surface.outcome.data() + first;
  float* valid = &map.valid[at];
  for (int i = 0; i < count; ++i) valid[i] = outcomes[i] == Outcome::Hit ? 1.0F : 0.0F;
  std::size_t pass = 0;
  BatchArray values;
  for (const Channel& channel : kChannels) {
    if (pass == map.passes.size() || map.passes[pass].channel != channel.name) continue;
    for (int i = 0; i < count; ++i) values[i] = channel.value(surface, first + i);
    store(values, count, &map.passes[pass++].values[at]);
  }
}

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

/// Traces a tile by batches of as many of its rows as fit, and stores it in the maps of `rows`.
void trace_tile(const Tracer& tracer, const Tile& tile, RowRange rows, TraceBatch& batch,
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
            static_cast<std::size_t>(row - rows.begin) * static_cast<std::size_t>(maps[k].width) +
            static_cast<std::size_t>(tile.left);
        store(batch.surfaces[k], (row - top) * width, width, at, maps[k]);
      }
    }
  }
}

/// Makes room in `map` for so many pixels; what it holds is not kept.
void make_room(int width, int height, const Effects& effects, LensMap& map) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  map.width = width;
  map.height = height;
  for (UnsetVector<float>* values : {&map.s, &map.t, &map.valid}) values->resize(pixels);
  std::size_t pass = 0;
  for (const Channel& channel : kChannels) {
    if (!(effects.*channel.effect)) continue;
    if (pass == map.passes.size()) map.passes.emplace_back();
    map.passes[pass].channel = channel.name;
    map.passes[pass++].values.resize(pixels);
  }
  map.passes.resize(pass);
}

}  // namespace

std::vector<LensMap> trace_maps(const Tracer& tracer) {
  return trace_maps(tracer, {0, tracer.camera().full_height()});
}

std::vector<LensMap> trace_maps(const Tracer& tracer, RowRange rows, std::vector<LensMap> maps) {
  const int width = tracer.camera().full_width();
  const int size = tracer.plan().tiles.size;
  maps.resize(tracer.surfaces().size());
  for (LensMap& map : maps) make_room(width, rows.end - rows.begin, tracer.plan().effects, map);
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
                        trace_tile(tracer, tile, rows, batch, maps);
                      }
                    });
  return maps;
}

}  // namespace lensplane
