// SPDX-License-Identifier: Apache-2.0
//
// An index of directions: which of many points at infinity lie near a given one?
//
// A k-d tree over unit vectors: it has no poles and no seam, and serves the whole sky as well as a field of a
// few degrees with all points in it.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/basis.h"

namespace lensplane {

class DirectionIndex {
 public:
  /// `directions`: unit vectors.
  explicit DirectionIndex(std::vector<Vec3> directions);

  const std::vector<Vec3>& directions() const { return directions_; }

  /// The numbers of all directions no farther than `chord` from `centre`, as the length of the difference of
  /// the unit vectors; 2 is the whole sky. In an order that depends on the index alone.
  std::vector<std::size_t> within(const Vec3& centre, double chord) const;

 private:
  struct Node {
    Vec3 direction;
    std::size_t number;
    int axis;  // along which the node divides its range
  };
  void divide(std::size_t begin, std::size_t end);
  void collect(std::size_t begin, std::size_t end, const Vec3& centre, double chord,
               std::vector<std::size_t>& found) const;

  std::vector<Vec3> directions_;
  std::vector<Node> nodes_;  // the middle one of a range divides it
};

}  // namespace lensplane
