// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/elliptical_filter.h"

#include <algorithm>
#include <cmath>

#include "pipeline/composite/weighted_sum.h"

namespace lensplane {
namespace {

// The Gaussian is exp(-q/2); q = kCut is its edge.
constexpr float kCut = 10;

/// exp(-q/2) for q in [0, kCut] within 4e-4 of itself, for a number or several at once: the exponential
/// series of a sixteenth, four times squared.
template <class Number>
constexpr Number gaussian(Number q) {
  const Number z = q * (1.0F / 32);
  Number power = 1.0F - z * (1.0F - z * (0.5F - z * (1.0F / 6 - z * (1.0F / 24))));
  power *= power;
  power *= power;
  power *= power;
  return power * power;
}

constexpr float kEdgeWeight = gaussian(kCut);

// What ending at kCut and lowering leave of the variance: with H = kCut/2 and e = exp(-H),
// (1 - e (1 + H + H^2/2)) / (1 - e (1 + H)) = 0.9123.
constexpr double kVarianceLeft = 0.91225;

/// Adds `count` texels of a row; the first lies `offset` from the row's centre, and q = per_variance d^2 +
/// base.
void add_run(const Rgba* texels, int count, float offset, float per_variance, float base,
             WeightedSum& total) {
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

Rgba elliptical_mean(Texels& texels, int level, double x, double y, const Covariance& wanted) {
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
    for (int column = static_cast<int>(std::ceil(centre - half)); column < end;) {
      const TexelRun run = texels.run(level, column, row);
      const int count = std::min(run.count, end - column);
      add_run(run.texels, count, static_cast<float>(column - centre), static_cast<float>(1 / variance),
              static_cast<float>(base), total);
      column += count;
    }
  }
  return total.mean();
}

}  // namespace lensplane
