// SPDX-License-Identifier: Apache-2.0
//
// Sums of texels by weight, as filters make them: rows in single precision, the sum of rows in double, so
// that what is constant stays so under filters of any size.

#pragma once

#include <cstring>

#include "pipeline/image/picture.h"
#include "src/inlining.h"

namespace lensplane {

/// Numbers that are worked with at once.
using Float4 [[gnu::vector_size(16)]] = float;
using Float8 [[gnu::vector_size(32)]] = float;

/// The sum of texels in single precision, each times its weight, and of the weights.
struct RowSum {
  Float4 colour{0, 0, 0, 0};
  float weight = 0;

  /// As WeightedSum::mean_or.
  template <class Otherwise>
  Rgba mean_or(Otherwise otherwise) const {
    if (!(weight > 0)) return otherwise();
    Rgba mean;
    for (std::size_t c = 0; c < 4; ++c) mean[c] = colour[c] / weight;
    return mean;
  }
};

/// Makes such sums by eight texels at a time, the last of which may weigh nothing: rows that ended in between
/// would cost more, because processors cannot guess where. Two texels fill a vector; two sums of such do not
/// wait for one another.
struct EightsSum {
  Float8 evens{0, 0, 0, 0, 0, 0, 0, 0}, odds{0, 0, 0, 0, 0, 0, 0, 0};
  Float8 weights{0, 0, 0, 0, 0, 0, 0, 0};

  LENSPLANE_ALWAYS_INLINE void add(const float* from, const Rgba* texels) {
    Float8 by;
    std::memcpy(&by, from, sizeof by);
    add(by, texels);
  }
  LENSPLANE_ALWAYS_INLINE void add(const Float8& by, const Rgba* texels) {
    using Lanes [[gnu::vector_size(32)]] = int;
    using Pair [[gnu::vector_size(32), gnu::aligned(4), gnu::may_alias]] = float;
    const auto* pair = reinterpret_cast<const Pair*>(texels);
    evens += __builtin_shuffle(by, Lanes{0, 0, 0, 0, 1, 1, 1, 1}) * pair[0];
    odds += __builtin_shuffle(by, Lanes{2, 2, 2, 2, 3, 3, 3, 3}) * pair[1];
    evens += __builtin_shuffle(by, Lanes{4, 4, 4, 4, 5, 5, 5, 5}) * pair[2];
    odds += __builtin_shuffle(by, Lanes{6, 6, 6, 6, 7, 7, 7, 7}) * pair[3];
    weights += by;
  }

  LENSPLANE_ALWAYS_INLINE RowSum sum() const {
    const Float8 both = evens + odds;
    const Float4 halves[] = {{weights[0], weights[1], weights[2], weights[3]},
                             {weights[4], weights[5], weights[6], weights[7]}};
    const Float4 four = halves[0] + halves[1];
    return {Float4{both[0], both[1], both[2], both[3]} + Float4{both[4], both[5], both[6], both[7]},
            (four[0] + four[2]) + (four[1] + four[3])};
  }
};

struct WeightedSum {
  std::array<double, 4> sum{};
  double weight = 0;

  LENSPLANE_ALWAYS_INLINE void add(const RowSum& row) {
    for (std::size_t c = 0; c < 4; ++c) sum[c] += static_cast<double>(row.colour[c]);
    weight += static_cast<double>(row.weight);
  }
  void add(double by, const Rgba& colour) {
    for (std::size_t c = 0; c < 4; ++c) sum[c] += by * static_cast<double>(colour[c]);
    weight += by;
  }
  /// Divided by the sum of weights; where nothing has been added there is no mean, and `otherwise()` is it: a
  /// texel, so that no hole opens in a picture.
  template <class Otherwise>
  Rgba mean_or(Otherwise otherwise) const {
    if (!(weight > 0)) return otherwise();
    Rgba mean;
    for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<float>(sum[c] / weight);
    return mean;
  }
};

}  // namespace lensplane
