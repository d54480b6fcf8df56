// SPDX-License-Identifier: Apache-2.0
//
// Sums of texels by weight, as filters make them: rows in single precision, the sum of rows in double, so
// that what is constant stays so under filters of any size.

#pragma once

#include <cstring>

#include "pipeline/image/picture.h"

namespace lensplane {

/// Four numbers that are worked with at once; every processor's vectors are at least as long.
using Float4 [[gnu::vector_size(16)]] = float;

struct RowSum {
  Float4 sum{0, 0, 0, 0};
  float weight = 0;

  void add(float by, const Rgba& texel) {
    Float4 colour;
    std::memcpy(&colour, texel.data(), sizeof colour);
    sum += by * colour;
    weight += by;
  }
  /// As WeightedSum::mean.
  Rgba mean() const {
    Rgba mean{0, 0, 0, 0};
    if (weight > 0) {
      for (std::size_t c = 0; c < 4; ++c) mean[c] = sum[c] / weight;
    }
    return mean;
  }
};

struct WeightedSum {
  std::array<double, 4> sum{};
  double weight = 0;

  void add(double by, const RowSum& row) {
    for (std::size_t c = 0; c < 4; ++c) sum[c] += by * static_cast<double>(row.sum[c]);
    weight += by * static_cast<double>(row.weight);
  }
  /// Divided by the sum of weights; transparent black without any.
  Rgba mean() const {
    Rgba mean{0, 0, 0, 0};
    if (weight > 0) {
      for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<float>(sum[c] / weight);
    }
    return mean;
  }
};

}  // namespace lensplane
