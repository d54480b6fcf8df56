// SPDX-License-Identifier: Apache-2.0
//
// Values that are constant or change over the frames of a shot.

#pragma once

#include <vector>

#include "src/basis.h"

namespace lensplane {

// Linear   straight from key to key; directions at an even pace
// Smooth   monotone cubic (Fritsch and Butland 1984): no overshoot, every component for itself; directions
//          turn as far as the cubic of the angle says, and pass a corner of their way the slower the sharper
//          it is
// Step     the last key's value until the next
enum class Interpolation { Linear, Smooth, Step };

/// A unit vector as the value of a key, between whose keys it turns.
struct Direction {
  Vec3 unit;
};

/// What a default-made track holds.
template <class T>
inline const T kWithoutKeys = T(0);
template <>
inline const Direction kWithoutKeys<Direction>{{0, 0, 1}};

/// A value over time. A constant has one key, whose frame does not matter.
template <class T>
struct Keyed {
  std::vector<double> frames{0.0};  // ascending
  std::vector<T> values{kWithoutKeys<T>};
  Interpolation interpolation = Interpolation::Linear;

  static Keyed constant(const T& value) { return {{0.0}, {value}, Interpolation::Linear}; }
};

/// The value at a frame (fractions allowed). Before the first key and after the last, theirs.
double value_at(const Keyed<double>& keyed, double frame);
Vec3 value_at(const Keyed<Vec3>& keyed, double frame);

/// The same, a unit vector: it turns along the great circle from key to key, the shorter way. Between
/// opposite keys that is right-handedly about the axis square to them that is nearest to the world's +x;
/// about +y where they point along x themselves.
Vec3 value_at(const Keyed<Direction>& keyed, double frame);

}  // namespace lensplane
