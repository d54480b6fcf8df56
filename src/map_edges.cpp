// SPDX-License-Identifier: Apache-2.0

#include "src/map_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "src/map_channels.h"

namespace lensplane {
namespace {

/// Adds to `apart` where samples of the row of `values` that begins at `at` differ from those of the row that
/// begins at `other`, or from their own neighbours there.
LENSPLANE_KERNEL void find_apart(const float* at, const float* other, int width, std::uint8_t* apart) {
#pragma GCC ivdep
  for (int i = 0; i < width; ++i) apart[i] |= static_cast<std::uint8_t>(at[i] != other[i]);
#pragma GCC ivdep
  for (int i = 1; i < width; ++i) apart[i] |= static_cast<std::uint8_t>(at[i] != other[i - 1]);
#pragma GCC ivdep
  for (int i = 0; i + 1 < width; ++i) apart[i] |= static_cast<std::uint8_t>(at[i] != other[i + 1]);
}

const UnsetVector<float>* shadow_of(const LensMap& map) {
  const auto pass = std::find_if(map.passes.begin(), map.passes.end(),
                                 [](const Pass& p) { return p.channel == kShadowChannel; });
  return pass == map.passes.end() ? nullptr : &pass->values;
}

/// The columns of a row at which a neighbour sees other surfaces, or another shadow.
std::vector<int> edges_of_row(const std::vector<LensMap>& maps, int row) {
  const LensMap& first = maps.front();
  std::vector<std::uint8_t> apart(static_cast<std::size_t>(first.width), 0);
  for (const LensMap& map : maps) {
    for (const UnsetVector<float>* values : {&map.valid, shadow_of(map)}) {
      if (!values) continue;
      for (int near = std::max(row - 1, 0); near <= std::min(row + 1, map.height - 1); ++near)
        find_apart(&(*values)[place_in(map, row, 0)], &(*values)[place_in(map, near, 0)], map.width,
                   apart.data());
    }
  }
  std::vector<int> columns;
  for (int column = 0; column < first.width; ++column) {
    if (apart[static_cast<std::size_t>(column)]) columns.push_back(column);
  }
  return columns;
}

/// The pixels beside `rows` that lie just beyond the film, by the row and column of the maps.
std::vector<MapPixel> beyond_film(const Camera& camera, RowRange rows) {
  const int width = camera.full_width(), height = rows.end - rows.begin;
  const bool at_top = rows.begin == 0, at_bottom = rows.end == camera.full_height();
  std::vector<MapPixel> beyond;
  for (int row = at_top ? -1 : 0; row < (at_bottom ? height + 1 : height); ++row) {
    const bool outside = row < 0 || row == height;
    for (int column = -1; column <= width; column += outside ? 1 : width + 1) beyond.push_back({row, column});
  }
  return beyond;
}

/// Adds to `edges` the pixels at the film's border whose neighbours beyond it see other surfaces, or another
/// shadow. Returns how many rays were traced.
std::int64_t add_border_edges(const Tracer& tracer, RowRange rows, const std::vector<LensMap>& maps,
                              std::vector<std::vector<int>>& edges) {
  const std::vector<MapPixel> beyond = beyond_film(tracer.camera(), rows);
  const int overscan = tracer.camera().overscan;
  const Tracer plain = tracer.without_passes();
  TraceBatch batch = plain.make_batch();
  const auto look_at = [&](const MapPixel& outside, int ray) {
    for (std::size_t k = 0; k < maps.size(); ++k) {
      const LensMap& map = maps[k];
      const Outcome outcome = batch.surfaces[k].outcome[static_cast<std::size_t>(ray)];
      const UnsetVector<float>* shadow = shadow_of(map);
      for (int row = std::max(outside.row - 1, 0); row <= std::min(outside.row + 1, map.height - 1); ++row) {
        for (const int column : {outside.column - 1, outside.column, outside.column + 1}) {
          if (column < 0 || column >= map.width) continue;
          const std::size_t at = place_in(map, row, column);
          if ((map.valid[at] != 0) != (outcome == Outcome::Hit) ||
              (shadow && ((*shadow)[at] != 0) != (outcome == Outcome::Captured)))
            edges[static_cast<std::size_t>(row)].push_back(column);
        }
      }
    }
  };
  for (std::size_t first = 0; first < beyond.size(); first += kBatchSize) {
    const std::size_t count = std::min<std::size_t>(kBatchSize, beyond.size() - first);
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const MapPixel& pixel = beyond[first + std::min(i, count - 1)];
      batch.x[i] = pixel.column - overscan + 0.5;
      batch.y[i] = rows.begin + pixel.row - overscan + 0.5;
    }
    plain.trace(batch);
    for (std::size_t i = 0; i < count; ++i) look_at(beyond[first + i], static_cast<int>(i));
  }
  for (std::vector<int>& columns : edges) {
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  }
  return static_cast<std::int64_t>(beyond.size());
}

}  // namespace

MapEdges find_edges(const Tracer& tracer, RowRange rows, const std::vector<LensMap>& maps) {
  const int height = rows.end - rows.begin;
  MapEdges edges;
  edges.columns.resize(static_cast<std::size_t>(height));
  tbb::parallel_for(0, height,
                    [&](int row) { edges.columns[static_cast<std::size_t>(row)] = edges_of_row(maps, row); });
  edges.rays = add_border_edges(tracer, rows, maps, edges.columns);
  return edges;
}

}  // namespace lensplane
