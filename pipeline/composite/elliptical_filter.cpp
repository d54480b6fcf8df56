// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/elliptical_filter.h"

#include <algorithm>
#include <cmath>

#include "pipeline/composite/gaussian_window.h"
#include "pipeline/composite/weighted_sum.h"
#include "src/batch.h"
#include "src/inlining.h"

namespace lensplane {
namespace {

/// Adds `count` texels of a row; the first lies `offset` from the row's centre, and q = per_variance d^2 +
/// base.
LENSPLANE_ALWAYS_INLINE inline void add_row(const Rgba* texels, int count, float offset, float per_variance,
                                            float base, WeightedSum& total) {
  RowSum sum;
  for (int first = 0; first < count; first += 4) {
    const Float4 d = (offset + static_cast<float>(first)) + Float4{0, 1, 2, 3};
    const Float4 q = per_variance * d * d + base;
    const Float4 weights = gaussian(q < kCut ? q : Float4{} + kCut) - kEdgeWeight;
    const int left = std::min(4, count - first);
    for (int i = 0; i < left; ++i) sum.add(weights[i], texels[first + i]);
  }
  total.add(1, sum);
}

}  // namespace

LENSPLANE_KERNEL Rgba elliptical_mean(Texels& texels, int level, double x, double y,
                                      const Covariance& wanted) {
  const Covariance c{wanted.xx / kVarianceLeft, wanted.xy / kVarianceLeft, wanted.yy / kVarianceLeft};
  // The Gaussian in a row: its centre moves by `slant` from row to row, its variance is the same in all.
  const double slant = c.xy / c.yy;
  const double variance = c.xx - c.xy * slant;
  const double reach = std::sqrt(kCut * c.yy);
  WeightedSum total;
  const int last_row = static_cast<int>(std::floor(y + reach));
  for (int row = static_cast<int>(std::ceil(y - reach)); row <= last_row; ++row) {
    const double down = row - y;
    const double base = down * down / c.yy;
    const double half = std::sqrt(std::max(0.0, (kCut - base) * variance));
    const double centre = x + slant * down;
    const int end = static_cast<int>(std::floor(centre + half)) + 1;
    const int first = static_cast<int>(std::ceil(centre - half));
    if (first >= end) continue;
    add_row(texels.row(level, first, row, end - first), end - first, static_cast<float>(first - centre),
            static_cast<float>(1 / variance), static_cast<float>(base), total);
  }
  return total.mean();
}

}  // namespace lensplane
