// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/map_composite.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace lensplane {
namespace {

double distance_at(const MapLayer& layer, std::size_t i) {
  if (layer.depth.empty()) return layer.distance;
  const float depth = layer.depth[i];
  if (!(depth > 0)) return layer.distance;  // painted into the map after it was traced
  return depth < std::numeric_limits<float>::max() ? depth : std::numeric_limits<double>::infinity();
}

/// What the layer shows at pixel `i`, premultiplied by its coverage.
Rgba seen_at(const MapLayer& layer, std::size_t i) {
  const TextureCoordinates st{layer.map.s[i], layer.map.t[i]};
  Rgba colour = shade(layer.surface, layer.look, st, layer.footprints[i]);
  for (float& channel : colour) channel *= layer.map.coverage[i];
  return colour;
}

bool is_sky(const MapLayer& layer) {
  return std::holds_alternative<LatLong>(layer.surface);
}

/// Layers that follow one another from the farthest at pixel `i`.
void sort_by_depth(const std::vector<MapLayer>& layers, std::size_t i, std::vector<std::size_t>& order) {
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double of_a = distance_at(layers[a], i), of_b = distance_at(layers[b], i);
    return of_a != of_b ? of_a > of_b : is_sky(layers[a]) && !is_sky(layers[b]);
  });
}

Rgba composite_at(const std::vector<MapLayer>& layers, std::size_t i, std::vector<std::size_t>& order) {
  if (layers.size() > 1) sort_by_depth(layers, i, order);
  Rgba colour{0, 0, 0, 0};
  for (auto k = order.rbegin(); k != order.rend() && colour[3] < 1.0F; ++k) {
    if (layers[*k].map.coverage[i] == 0) continue;
    const float clear = 1.0F - colour[3];
    const Rgba under = seen_at(layers[*k], i);
    for (std::size_t c = 0; c < 4; ++c) colour[c] += clear * under[c];
  }
  return colour;
}

}  // namespace

Picture composite_from_maps(const std::vector<MapLayer>& layers) {
  assert(!layers.empty());
  const StMap& first = layers.front().map;
  Picture picture{first.width, first.height, first.x, first.y, first.display_width, first.display_height, {}};
  picture.pixels.resize(first.s.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, picture.pixels.size(), 4096), [&](const auto& range) {
    std::vector<std::size_t> order(layers.size());
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      picture.pixels[i] = composite_at(layers, i, order);
  });
  return picture;
}

}  // namespace lensplane
