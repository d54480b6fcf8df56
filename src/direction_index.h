// SPDX-License-Identifier: Apache-2.0
//
// An index of directions: which of many points at infinity lie near a given one?
//
// A k-d tree over unit vectors, every node with a ball round its points: it has no poles and no seam, and
// serves the whole sky as well as a field of a few degrees with all points in it.

#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "src/basis.h"

namespace lensplane {

/// A piece of sky: within a chord of its middle (the length of the difference of unit vectors; 2 is the whole
/// sky), and in a band along a great circle through it. Images of small cells can be long and thin.
struct SkyPatch {
  Vec3 middle{0};    // unit vector
  double chord = 2;  // from the middle
  Vec3 across{0};    // unit vector perpendicular to the great circle; 0: no band
  double width = 0;  // sine of the angle from the great circle

  bool contains(const Vec3& direction) const { return reaches(direction, 0.0); }

  /// May the patch have a point within `radius` of `point`?
  bool reaches(const Vec3& point, double radius) const {
    const double far = chord + radius;
    return (point - middle).length2() <= far * far && std::abs(across.dot(point)) <= width + radius;
  }
};

class DirectionIndex {
 public:
  /// `directions`: unit vectors.
  explicit DirectionIndex(std::vector<Vec3> directions);

  const std::vector<Vec3>& directions() const { return directions_; }

  /// The numbers of all directions in the patch, in an order that depends on index and patch alone.
  std::vector<std::size_t> within(const SkyPatch& patch) const;

 private:
  struct Node {
    Vec3 direction;
    std::size_t number;
    Vec3 middle{0};     // of the directions of the range that the node divides
    double radius = 0;  // in which they lie round it
  };
  void divide(std::size_t begin, std::size_t end);
  void collect(std::size_t begin, std::size_t end, const SkyPatch& patch,
               std::vector<std::size_t>& found) const;

  std::vector<Vec3> directions_;
  std::vector<Node> nodes_;  // the middle one of a range divides it
};

}  // namespace lensplane
