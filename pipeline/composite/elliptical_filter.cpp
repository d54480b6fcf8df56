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

/// Adds the texels of a row, by eights; the first lies `offset` from the row's centre, and q = per_variance
/// d^2 + base. Those beyond the window weigh nothing.
LENSPLANE_ALWAYS_INLINE inline void add_row(const Rgba* texels, int eights, float offset, float per_variance,
                                            float base, WeightedSum& total) {
  EightsSum sum;
  for (int n = 0; n < 8 * eights; n += 8) {
    const Float8 d = (offset + static_cast<float>(n)) + Float8{0, 1, 2, 3, 4, 5, 6, 7};
    const Float8 q = per_variance * d * d + base;
    const Float8 weights = windowed_gaussian(q < kCut ? q : Float8{} + kCut);
    sum.add(weights > 0 ? weights : Float8{}, texels + n);  // rounding makes nothing less than nothing
  }
  total.add(sum.sum());
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
    const int eights = (end - first + 7) / 8;
    add_row(texels.row(level, first, row, 8 * eights), eights, static_cast<float>(first - centre),
            static_cast<float>(1 / variance), static_cast<float>(base), total);
  }
  return total.mean_or([&] { return texels.nearest(level, x, y); });
}

}  // namespace lensplane
