// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/planned_frame.h"

#include <algorithm>
#include <limits>

namespace lensplane {

std::vector<LensPlan> lenses_of(const PlannedFrame& planned) {
  if (planned.plan.method == Method::Planes) return planned.plan.lenses;
  std::vector<LensPlan> lenses;
  for (std::size_t i = 0; i < planned.scene.lenses.size(); ++i) {
    LensPlan lens;
    lens.lens = i;
    lens.moves_px = std::numeric_limits<double>::infinity();
    lens.reason = "the method leaves no lens out";
    lenses.push_back(lens);
  }
  return lenses;
}

double distance_of(const PlannedFrame& planned, const LensPlan& lens) {
  return (planned.scene.lenses[lens.lens].position - planned.scene.camera.position).length();
}

std::vector<double> shares_of(const PlannedFrame& planned) {
  const TileLevels& tiles = planned.plan.tiles;
  std::vector<double> shares(planned.plan.recipes.size(), 0.0);
  if (shares.empty()) return shares;
  if (tiles.level.empty()) {
    shares.back() = 1.0;
    return shares;
  }
  const double width = planned.scene.camera.full_width(), height = planned.scene.camera.full_height();
  const auto extent = [&](int tile, double film) {
    return std::clamp(film - static_cast<double>(tile) * tiles.size, 0.0, static_cast<double>(tiles.size));
  };
  for (std::size_t i = 0; i < tiles.level.size(); ++i) {
    const int column = static_cast<int>(i) % tiles.columns, row = static_cast<int>(i) / tiles.columns;
    shares[tiles.level[i]] += extent(column, width) * extent(row, height) / (width * height);
  }
  return shares;
}

}  // namespace lensplane
