// SPDX-License-Identifier: Apache-2.0
//
// Values that are constant or change over the frames of a shot.

#pragma once

#include <vector>

#include "src/basis.h"

namespace lensplane {

// Linear   straight from key to key
// Smooth   monotone cubic (Fritsch and Butland 1984): no overshoot, every component for itself
// Step     the last key's value until the next
enum class Interpolation { Linear, Smooth, Step };

/// A value over time. A constant has one key, whose frame does not matter.
template <class T>
struct Keyed {
  std::vector<double> frames{0.0};  // ascending
  std::vector<T> values{T(0)};
  Interpolation interpolation = Interpolation::Linear;

  static Keyed constant(const T& value) { return {{0.0}, {value}, Interpolation::Linear}; }
};

/// The value at a frame (fractions allowed). Before the first key and after the last, theirs.
double value_at(const Keyed<double>& keyed, double frame);
Vec3 value_at(const Keyed<Vec3>& keyed, double frame);

}  // namespace lensplane
