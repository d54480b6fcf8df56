// SPDX-License-Identifier: Apache-2.0
//
// What keeps the cubic surface from ringing: no colour beyond the range of the texels around it.
//
// Beside a highlight the cubic's negative lobes would draw a dark ring, and beside opaque texels alpha above
// 1. Channels are limited each by itself; as texels are premultiplied, what is limited is light.

#pragma once

#include <algorithm>
#include <cstring>
#include <limits>

#include "pipeline/composite/surface_kernel.h"
#include "pipeline/composite/weighted_sum.h"

namespace lensplane {

class LocalRange {
 public:
  /// `pairs` times two texels side by side.
  LENSPLANE_ALWAYS_INLINE void add(const Rgba* texels, int pairs) {
    for (int n = 0; n < pairs; ++n) {
      Float8 two;
      std::memcpy(&two, texels + 2 * n, sizeof two);
      least_ = two < least_ ? two : least_;
      most_ = two > most_ ? two : most_;
    }
  }

  /// The colour as far as it lies within the range.
  LENSPLANE_ALWAYS_INLINE Rgba limited(const Rgba& colour) const {
    Rgba result;
    for (std::size_t c = 0; c < 4; ++c) {
      const float least = std::min(least_[c], least_[c + 4]), most = std::max(most_[c], most_[c + 4]);
      result[c] = std::max(least, std::min(most, colour[c]));
    }
    return result;
  }

  /// How many pairs of texels side by side, and how many before the one on the left of a place, a Gaussian of
  /// this variance spreads the light of.
  struct Width {
    int pairs, before;
  };
  static Width width(double variance) {
    constexpr double kNarrow = 0.15, kWide = 0.4;
    if (variance > kWide) return {4, 3};
    return variance < kNarrow ? Width{2, 1} : Width{3, 2};
  }

 private:
  static constexpr float kMost = std::numeric_limits<float>::max();
  Float8 least_ = Float8{} + kMost, most_ = Float8{} - kMost;
};

}  // namespace lensplane
