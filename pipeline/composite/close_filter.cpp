// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/close_filter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/composite/gaussian_window.h"
#include "pipeline/composite/surface_kernel.h"
#include "pipeline/composite/weighted_sum.h"
#include "src/batch.h"
#include "src/inlining.h"

namespace lensplane {
namespace {

// The variance of the triangle.
constexpr double kTriangleVariance = 1.0 / 6;

/// The whole numbers from `first` to `last`.
struct Span {
  int first, last;
};

Span span_around(double middle, double reach) {
  return {static_cast<int>(std::ceil(middle - reach)), static_cast<int>(std::floor(middle + reach))};
}

/// What columns (or rows) weigh together along the longer axis.
class Marginal {
 public:
  Marginal(double middle, double variance, double smoothness) {
    if (variance <= kLargestCloseSigma * kLargestCloseSigma) {
      const SurfaceKernel kernel(variance, smoothness);
      span_ = span_around(middle, kernel.reach());
      for (int i = span_.first; i <= span_.last; ++i) at(i) = kernel(static_cast<float>(i - middle));
      return;
    }
    // One dimension's share of the window loses a little less variance than two do.
    const double widened = (variance + kTriangleVariance) / 0.94;
    span_ = span_around(middle, std::sqrt(static_cast<double>(kCut) * widened));
    for (int i = span_.first; i <= span_.last; ++i) {
      const double q = (i - middle) * (i - middle) / widened;
      at(i) = std::max(0.0F, gaussian(static_cast<float>(q)) - kEdgeWeight);
    }
  }

  Span span() const { return span_; }
  /// The weights from number `i` on.
  const float* from(int i) const { return &weights_[static_cast<std::size_t>(i - span_.first)]; }

 private:
  float& at(int i) { return weights_[static_cast<std::size_t>(i - span_.first)]; }

  static constexpr int kMost = static_cast<int>(2 * 3.3 * kLongestCloseSigma) + 8;
  Span span_{};
  std::array<float, kMost> weights_;
};

/// The spread within a column (or a row): about a middle that moves by `slant` from one to the next.
struct Conditional {
  double slant;
  SurfaceKernel kernel;
};

/// A variance and how cubic the surface is, along one axis.
struct AxisFilter {
  double variance, smoothness;

  /// The variance of the surface's own weights.
  double of_surface() const {
    return kTriangleVariance + smoothness * (kCubicSplineVariance - kTriangleVariance);
  }
};

/// `between`: the covariance of the two axes.
Conditional conditional(const AxisFilter& along, const AxisFilter& across, double between) {
  const double slant = between / (along.variance + along.of_surface());
  return {slant, SurfaceKernel(std::max(0.0, across.variance - slant * between), across.smoothness)};
}

/// Adds texels side by side, number n by weight(n). No ellipse has so many that single precision lost them.
template <class Weight>
LENSPLANE_ALWAYS_INLINE inline void add_texels(const Rgba* texels, int count, Weight weight, RowSum& sum) {
  for (int n = 0; n < count; ++n) sum.add(weight(n), texels[n]);
}

/// The ellipse is longer along rows: columns are weighed, and within each its rows.
LENSPLANE_KERNEL Rgba mean_along_rows(Texels& texels, double x, double y, const Marginal& columns,
                                      const Conditional& within) {
  const Span all = columns.span();
  const SurfaceKernel& kernel = within.kernel;
  const double reach = kernel.reach();
  const double sway = std::abs(within.slant) * std::max(x - all.first, all.last - x);
  const Span rows = span_around(y, reach + sway);
  const auto slant = static_cast<float>(within.slant);
  RowSum sum;
  for (int row = rows.first; row <= rows.last; ++row) {
    Span in_row = all;
    if (sway > 1) {
      const double middle = x + (row - y) / within.slant, half = reach / std::abs(within.slant);
      in_row.first = static_cast<int>(std::ceil(std::max(static_cast<double>(all.first), middle - half)));
      in_row.last = static_cast<int>(std::floor(std::min(static_cast<double>(all.last), middle + half)));
      if (in_row.last < in_row.first) continue;
    }
    const int count = in_row.last - in_row.first + 1;
    const Rgba* texel = texels.row(0, in_row.first, row, count);
    const float* column = columns.from(in_row.first);
    const auto away = static_cast<float>(row - y - within.slant * (in_row.first - x));
    if (kernel.is_triangle()) {
      const auto weight = [=](int n) {
        return column[n] * kernel.triangle(away - slant * static_cast<float>(n));
      };
      add_texels(texel, count, weight, sum);
    } else {
      const auto weight = [=](int n) { return column[n] * kernel(away - slant * static_cast<float>(n)); };
      add_texels(texel, count, weight, sum);
    }
  }
  return sum.mean();
}

/// The ellipse is longer along columns: rows are weighed, and within each its columns.
LENSPLANE_KERNEL Rgba mean_along_columns(Texels& texels, double x, double y, const Marginal& rows,
                                         const Conditional& within) {
  const SurfaceKernel& kernel = within.kernel;
  const double reach = kernel.reach();
  RowSum sum;
  for (int row = rows.span().first; row <= rows.span().last; ++row) {
    const double middle = x + within.slant * (row - y);
    const Span columns = span_around(middle, reach);
    const int count = columns.last - columns.first + 1;
    const Rgba* texel = texels.row(0, columns.first, row, count);
    const auto away = static_cast<float>(columns.first - middle);
    const float by = *rows.from(row);
    if (kernel.is_triangle()) {
      add_texels(
          texel, count, [=](int n) { return by * kernel.triangle(away + static_cast<float>(n)); }, sum);
    } else {
      add_texels(
          texel, count, [=](int n) { return by * kernel(away + static_cast<float>(n)); }, sum);
    }
  }
  return sum.mean();
}

}  // namespace

Rgba close_mean(Texels& texels, double x, double y, const Covariance& pixel, Smoothness smoothness) {
  const AxisFilter columns{pixel.xx, smoothness.x}, rows{pixel.yy, smoothness.y};
  if (pixel.xx >= pixel.yy) {
    return mean_along_rows(texels, x, y, Marginal(x, columns.variance, columns.smoothness),
                           conditional(columns, rows, pixel.xy));
  }
  return mean_along_columns(texels, x, y, Marginal(y, rows.variance, rows.smoothness),
                            conditional(rows, columns, pixel.xy));
}

}  // namespace lensplane
