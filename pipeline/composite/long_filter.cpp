// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/long_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/composite/gaussian_window.h"
#include "pipeline/composite/local_range.h"
#include "pipeline/composite/surface_kernel.h"
#include "pipeline/composite/weighted_sum.h"
#include "src/batch.h"
#include "src/inlining.h"

namespace lensplane {
namespace {

/// The whole numbers from `first` to `last`.
struct Span {
  int first, last;
};

Span span_around(double middle, double reach) {
  return {static_cast<int>(std::ceil(middle - reach)), static_cast<int>(std::floor(middle + reach))};
}

/// The eight texels side by side that a kernel may reach around `middle`, and what they weigh.
struct TapRun {
  int first;
  Taps taps;

  LENSPLANE_ALWAYS_INLINE TapRun(const SurfaceKernel& kernel, double middle) {
    const double before = std::floor(middle);
    first = static_cast<int>(before) + SurfaceKernel::kFirstTap;
    taps = kernel.taps(static_cast<float>(middle - before));
  }
};

int by_eights(int count) {
  return (count + Taps::kCount - 1) / Taps::kCount * Taps::kCount;
}

/// What rows (or columns) weigh together: a Gaussian.
class Marginal {
 public:
  LENSPLANE_ALWAYS_INLINE Marginal(double middle, double variance) {
    set(middle, variance);
    std::fill_n(&weights_[static_cast<std::size_t>(count())], Taps::kCount, 0.0F);
  }

  Span span() const { return span_; }
  /// The weights from number `i` on, and eight more of nothing.
  const float* from(int i) const { return &weights_[static_cast<std::size_t>(i - span_.first)]; }

  /// More than there can be, those eight included.
  static constexpr int kMost = static_cast<int>(2 * 3.5 * kLongestSigma) + 2 * Taps::kCount;

 private:
  int count() const { return span_.last - span_.first + 1; }

  LENSPLANE_ALWAYS_INLINE void set(double middle, double variance) {
    // Lowered as a whole: along one line that is as near to a Gaussian, and costs least.
    const double widened = variance / kVarianceLeft;
    span_ = span_around(middle, std::sqrt(static_cast<double>(kCut) * widened));
    const auto per_variance = static_cast<float>(1 / widened);
    const auto offset = static_cast<float>(span_.first - middle);
    for (int n = 0; n < count(); ++n) {
      const float distance = offset + static_cast<float>(n);
      const float q = distance * distance * per_variance;
      weights_[static_cast<std::size_t>(n)] = std::max(0.0F, gaussian(q < kCut ? q : kCut) - kEdgeWeight);
    }
  }

  Span span_{};
  std::array<float, kMost> weights_;
};

/// The spread within a column (or a row): about a middle that moves by `slant` from one to the next.
struct Conditional {
  double slant, variance;
  SurfaceKernel kernel;
  double surface;  // what the surface adds to the other axis' variance
};

/// `between`: the covariance of the two axes. The cubic across the rows takes its part in how they lean.
Conditional conditional(double along, double across, double between) {
  const double variance = std::max(0.0, across - between * between / along);
  const double surface = surface_variance(variance);
  return {between / (along + surface), variance, SurfaceKernel(variance, std::abs(between / along)), surface};
}

/// Columns are weighed, and within each its rows.
LENSPLANE_ALWAYS_INLINE inline Rgba mean_along_rows(Texels& texels, double x, double y,
                                                    const Marginal& columns, const Conditional& within) {
  const Span all = columns.span();
  const SurfaceKernel& kernel = within.kernel;
  const double reach = kernel.reach();
  const double sway = std::abs(within.slant) * std::max(x - all.first, all.last - x);
  const Span rows = span_around(y, reach + sway);
  const auto slant = static_cast<float>(within.slant);
  EightsSum sum;
  LocalRange range;
  for (int row = rows.first; row <= rows.last; ++row) {
    Span in_row = all;
    if (sway > 1) {
      const double middle = x + (row - y) / within.slant, half = reach / std::abs(within.slant);
      in_row.first = static_cast<int>(std::ceil(std::max(static_cast<double>(all.first), middle - half)));
      in_row.last = static_cast<int>(std::floor(std::min(static_cast<double>(all.last), middle + half)));
      if (in_row.last < in_row.first) continue;
    }
    const int count = by_eights(in_row.last - in_row.first + 1);
    const auto away = static_cast<float>(row - y - within.slant * (in_row.first - x));
    alignas(32) float weights[Marginal::kMost];
    std::copy_n(columns.from(in_row.first), count, weights);
    kernel.weigh(away, -slant, count, weights);
    const Rgba* texel = texels.row(0, in_row.first, row, count);
    for (int n = 0; n < count; n += Taps::kCount) sum.add(weights + n, texel + n);
    range.add(texel, count / 2);
  }
  const Rgba mean = sum.sum().mean_or([&] { return texels.nearest(0, x, y); });
  return range.limited(mean);
}

/// Rows are weighed, and within each its columns.
LENSPLANE_ALWAYS_INLINE inline Rgba mean_along_columns(Texels& texels, double x, double y,
                                                       const Marginal& rows, const Conditional& within) {
  const LocalRange::Width width = LocalRange::width(within.variance);
  EightsSum sum;
  LocalRange range;
  for (int row = rows.span().first; row <= rows.span().last; ++row) {
    const TapRun run(within.kernel, x + within.slant * (row - y));
    const float by = *rows.from(row);
    alignas(32) float weights[Taps::kCount];
    for (int n = 0; n < Taps::kCount; ++n) weights[n] = by * run.taps.weight[n];
    const Rgba* texel = texels.row(0, run.first, row, Taps::kCount);
    sum.add(weights, texel);
    range.add(texel - SurfaceKernel::kFirstTap - width.before, width.pairs);
  }
  const Rgba mean = sum.sum().mean_or([&] { return texels.nearest(0, x, y); });
  return range.limited(mean);
}

/// Whether rows are what is weighed: that is quicker, but a kernel has to hold what is within each.
bool rows_are_weighed(const Covariance& pixel) {
  if (pixel.yy >= pixel.xx) return true;
  constexpr double kMostSlant = 1;
  constexpr double kLargest = KernelTable::kLargestSigma * KernelTable::kLargestSigma;
  return pixel.yy >= kSmallestLongVariance && std::abs(pixel.xy) <= kMostSlant * pixel.yy &&
         pixel.xx - pixel.xy * pixel.xy / pixel.yy <= kLargest;
}

}  // namespace

LENSPLANE_KERNEL Rgba long_mean(Texels& texels, double x, double y, const Covariance& pixel) {
  if (rows_are_weighed(pixel)) {
    const Conditional within = conditional(pixel.yy, pixel.xx, pixel.xy);
    return mean_along_columns(texels, x, y, Marginal(y, pixel.yy + within.surface), within);
  }
  const Conditional within = conditional(pixel.xx, pixel.yy, pixel.xy);
  return mean_along_rows(texels, x, y, Marginal(x, pixel.xx + within.surface), within);
}

}  // namespace lensplane
