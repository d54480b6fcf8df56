// SPDX-License-Identifier: Apache-2.0

#include "src/direction_index.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lensplane {
namespace {

/// Ranges of so few directions are not divided.
constexpr std::size_t kLeaf = 8;

/// More than what rounding moves a direction.
constexpr double kRounding = 1e-14;

}  // namespace

DirectionIndex::DirectionIndex(std::vector<Vec3> directions) : directions_(std::move(directions)) {
  nodes_.reserve(directions_.size());
  for (std::size_t i = 0; i < directions_.size(); ++i) nodes_.push_back({directions_[i], i});
  divide(0, nodes_.size());
}

std::vector<std::size_t> DirectionIndex::within(const SkyPatch& patch) const {
  std::vector<std::size_t> found;
  collect(0, nodes_.size(), patch, found);
  return found;
}

void DirectionIndex::divide(std::size_t begin, std::size_t end) {
  if (end - begin <= kLeaf) return;
  Vec3 least(std::numeric_limits<double>::max()), most(std::numeric_limits<double>::lowest());
  for (std::size_t i = begin; i < end; ++i) {
    for (int k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], nodes_[i].direction[k]);
      most[k] = std::max(most[k], nodes_[i].direction[k]);
    }
  }
  const Vec3 extent = most - least;
  const int axis = extent.x >= std::max(extent.y, extent.z) ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [this](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Node& a, const Node& b) {
    return std::pair(a.direction[axis], a.number) < std::pair(b.direction[axis], b.number);
  });
  Node& node = nodes_[middle];
  node.middle = (least + most) / 2.0;
  for (std::size_t i = begin; i < end; ++i) {
    node.radius = std::max(node.radius, (nodes_[i].direction - node.middle).length());
  }
  node.radius *= 1.0 + kRounding;
  divide(begin, middle);
  divide(middle + 1, end);
}

void DirectionIndex::collect(std::size_t begin, std::size_t end, const SkyPatch& patch,
                             std::vector<std::size_t>& found) const {
  const auto take = [&](const Node& node) {
    if (patch.contains(node.direction)) found.push_back(node.number);
  };
  if (end - begin <= kLeaf) {
    for (std::size_t i = begin; i < end; ++i) take(nodes_[i]);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const Node& node = nodes_[middle];
  if (!patch.reaches(node.middle, node.radius + kRounding)) return;
  take(node);
  collect(begin, middle, patch, found);
  collect(middle + 1, end, patch, found);
}

}  // namespace lensplane
