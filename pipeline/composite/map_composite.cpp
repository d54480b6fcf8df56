// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/map_composite.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include "pipeline/composite/coverage_mask.h"

namespace lensplane {
namespace {

double distance_at(const MapLayer& layer, std::size_t i) {
  if (layer.depth.empty()) return layer.distance;
  const float depth = layer.depth[i];
  if (!(depth > 0)) return layer.distance;  // painted into the map after it was traced
  return depth < std::numeric_limits<float>::max() ? depth : std::numeric_limits<double>::infinity();
}

Rgba colour_at(const MapLayer& layer, const MapPlace& place) {
  return shade(layer.surface, layer.look, place.st, place.footprint);
}

MapPlace place_at(const MapLayer& layer, std::size_t i) {
  return {{layer.map.s[i], layer.map.t[i]}, layer.footprints[i]};
}

bool is_edge(const MapLayer& layer, std::size_t i) {
  return layer.map.coverage[i] > 0 && layer.map.coverage[i] < 1;
}

/// Adds what shines through a surface that is `clear` as far as what lies before it lets it.
void add(float clear, const Rgba& under, Rgba& colour) {
  for (std::size_t c = 0; c < 4; ++c) colour[c] += clear * under[c];
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

/// A layer as it is seen in a pixel that some layer covers in part.
struct SeenPart {
  Rgba colour;  // of the covered part
  CoverageMask mask;
};

/// The layers over one another, share by share of the pixel. `order`: farthest first.
Rgba composite_parts_at(const std::vector<MapLayer>& layers, std::size_t i,
                        const std::vector<std::size_t>& order) {
  const StMap& windows = layers.front().map;
  const int column = static_cast<int>(i % static_cast<std::size_t>(windows.width));
  const int row = static_cast<int>(i / static_cast<std::size_t>(windows.width));
  std::vector<SeenPart> parts;
  for (auto k = order.rbegin(); k != order.rend(); ++k) {
    const MapLayer& layer = layers[*k];
    const float coverage = layer.map.coverage[i];
    if (coverage == 0) continue;
    CoverageMask mask = coverage_mask(layer.map, column, row);
    const Rgba colour = colour_at(layer, covered_part(place_at(layer, i), mask, coverage));
    parts.push_back({colour, std::move(mask)});
  }
  Rgba colour{0, 0, 0, 0};
  const std::size_t shares = parts.front().mask.size();
  for (std::size_t share = 0; share < shares; ++share) {
    Rgba seen{0, 0, 0, 0};
    for (const SeenPart& part : parts) add((1.0F - seen[3]) * part.mask[share], part.colour, seen);
    add(1.0F / static_cast<float>(shares), seen, colour);
  }
  return colour;
}

Rgba composite_at(const std::vector<MapLayer>& layers, std::size_t i, std::vector<std::size_t>& order) {
  if (layers.size() > 1) sort_by_depth(layers, i, order);
  if (std::any_of(layers.begin(), layers.end(), [&](const MapLayer& layer) { return is_edge(layer, i); }))
    return composite_parts_at(layers, i, order);
  Rgba colour{0, 0, 0, 0};
  for (auto k = order.rbegin(); k != order.rend() && colour[3] < 1.0F; ++k) {
    if (layers[*k].map.coverage[i] != 0)
      add(1.0F - colour[3], colour_at(layers[*k], place_at(layers[*k], i)), colour);
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
