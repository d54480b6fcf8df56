// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/coverage_mask.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "pipeline/composite/sample_pattern.h"

namespace lensplane {
namespace {

const std::vector<FilmOffset>& points() {
  static const FilmFilter filter = coverage_filter();
  return filter.points;
}

/// The unit vector on the film towards more coverage; nothing where it is no sharp edge that changes it.
std::optional<FilmOffset> inward(const StMap& map, int column, int row) {
  const auto coverage = [&](int x, int y) {
    return double{map.coverage[map.index(std::clamp(column + x, 0, map.width - 1),
                                         std::clamp(row + y, 0, map.height - 1))]};
  };
  double least = 1, most = 0;
  FilmOffset slope;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const double value = coverage(x, y);
      least = std::min(least, value), most = std::max(most, value);
      slope.x += x * (y == 0 ? 2 : 1) * value;
      slope.y += y * (x == 0 ? 2 : 1) * value;
    }
  }
  const double steepness = std::hypot(slope.x, slope.y);
  if (most - least < kSharpEdge || steepness < kSharpEdge) return std::nullopt;
  return FilmOffset{slope.x / steepness, slope.y / steepness};
}

}  // namespace

CoverageMask coverage_mask(const StMap& map, int column, int row) {
  const float coverage = map.coverage[map.index(column, row)];
  CoverageMask mask(points().size(), coverage);
  if (coverage == 0 || coverage == 1) return mask;
  const auto towards = inward(map, column, row);
  if (!towards) return mask;
  std::vector<std::size_t> order(points().size());  // from the farthest inward
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto depth = [&](std::size_t i) { return points()[i].x * towards->x + points()[i].y * towards->y; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return depth(a) > depth(b); });
  float left = coverage * static_cast<float>(order.size());
  for (const std::size_t i : order) {
    mask[i] = std::clamp(left, 0.0F, 1.0F);
    left -= 1;
  }
  return mask;
}

MapPlace covered_part(const MapPlace& place, const CoverageMask& mask, float coverage) {
  FilmOffset middle;
  double weight = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    middle.x += double{mask[i]} * points()[i].x, middle.y += double{mask[i]} * points()[i].y;
    weight += double{mask[i]};
  }
  const double away = std::hypot(middle.x, middle.y) / weight;
  if (!(away > 1e-6)) return place;
  const FilmOffset towards{middle.x / weight / away, middle.y / weight / away};
  double variance = 0;  // of the covered part, towards its middle
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const double off = points()[i].x * towards.x + points()[i].y * towards.y - away;
    variance += double{mask[i]} * off * off / weight;
  }
  const Footprint& f = place.footprint;
  const double ds = f.ds_dx * towards.x + f.ds_dy * towards.y;  // per pixel towards the middle
  const double dt = f.dt_dx * towards.x + f.dt_dy * towards.y;
  const double narrower = std::min(std::sqrt(variance) / kPixelSigma, 1.0) - 1;
  MapPlace part = place;
  part.footprint.ds_dx += narrower * ds * towards.x, part.footprint.ds_dy += narrower * ds * towards.y;
  part.footprint.dt_dx += narrower * dt * towards.x, part.footprint.dt_dy += narrower * dt * towards.y;
  if (coverage > 0.5F) part.st.s += away * ds, part.st.t += away * dt;
  return part;
}

}  // namespace lensplane
