// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/close_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/composite/cubic_spline.h"
#include "pipeline/composite/weighted_sum.h"

namespace lensplane {
namespace {

// The Gaussian's reach in standard deviations, here and along the longer axis: one part in a thousand lies
// beyond.
constexpr double kReach = 3.2;

// A triangle reaches 1 texel, a spline 2; more than kReach of the Gaussian beside the one, and a standard
// deviation beside the other, count for nothing.
constexpr int kMostTaps = static_cast<int>(2 * (1 + kReach * kLargestCloseSigma)) + 1;

/// z Phi(z) + phi(z), the second integral of the normal distribution's density phi, from a table.
class RampIntegral {
 public:
  RampIntegral() {
    for (int i = 0; i <= kSteps + 1; ++i) {
      const double z = i / kPerUnit - kEnd;
      const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
      const double value = z * std::erfc(-z / std::numbers::sqrt2) / 2 + density;
      values_[static_cast<std::size_t>(i)] = std::abs(z) < kEnd ? value : std::max(z, 0.0);
    }
  }
  double operator()(double z) const {
    // Beyond the table the function is straight.
    const double inside = std::min(std::max(z, -kEnd), kEnd);
    const double place = (inside + kEnd) * kPerUnit;
    const auto i = static_cast<int>(place);
    const double before = values_[static_cast<std::size_t>(i)],
                 after = values_[static_cast<std::size_t>(i) + 1];
    return before + (after - before) * (place - i) + std::max(z - kEnd, 0.0);
  }

 private:
  static constexpr double kEnd = 5;
  static constexpr double kPerUnit = 128;
  static constexpr int kSteps = static_cast<int>(2 * kEnd * kPerUnit);
  std::array<double, kSteps + 2> values_;
};

/// Weights of texels along one axis.
struct Taps {
  int first = 0;
  int count = 0;
  std::array<float, kMostTaps> weights;
};

/// The weights of the texels around `x` for a Gaussian of `sigma` over the surface.
Taps taps_around(double x, double sigma, double smoothness) {
  static const RampIntegral ramp_integral;
  const double reach = std::max(1 + kReach * sigma, smoothness > 0 ? 2 + sigma : 0);
  Taps taps;
  taps.first = static_cast<int>(std::ceil(x - reach));
  taps.count = std::min(static_cast<int>(std::floor(x + reach)) - taps.first + 1, kMostTaps);
  const double start = taps.first - x;
  // The triangle's convolution with the Gaussian: the second difference of the ramp's.
  std::array<double, kMostTaps + 2> ramp;
  const double per_sigma = 1 / sigma;
  for (int i = 0; i < taps.count + 2; ++i) {
    ramp[static_cast<std::size_t>(i)] = ramp_integral((start + (i - 1)) * per_sigma);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(taps.count); ++i) {
    double weight = sigma * (ramp[i] - 2 * ramp[i + 1] + ramp[i + 2]);
    // The spline is smooth: two points stand for the narrow Gaussian.
    if (smoothness > 0) {
      const double d = start + static_cast<double>(i);
      const double spline = (cubic_spline(d - sigma) + cubic_spline(d + sigma)) / 2;
      weight += smoothness * (spline - weight);
    }
    taps.weights[i] = static_cast<float>(weight);
  }
  return taps;
}

RowSum row_sum(Texels& texels, const Taps& columns, int row) {
  RowSum sum;
  for (int i = 0; i < columns.count;) {
    const TexelRun run = texels.run(0, columns.first + i, row);
    const int count = std::min(run.count, columns.count - i);
    for (int k = 0; k < count; ++k) sum.add(columns.weights[static_cast<std::size_t>(i + k)], run.texels[k]);
    i += count;
  }
  return sum;
}

/// Points along the longer axis, in standard deviations `along` of what it is longer by: they stand for a
/// Gaussian. Few suffice where the surface hardly bends between them (Gauss's formulas); many are evenly
/// spaced, at most one standard deviation apart.
template <class Use>
void for_each_point(double along, Use use) {
  if (along < 1e-3) return use(0.0, 1.0);
  if (along < 0.15) return use(-1.0, 0.5), use(1.0, 0.5);
  if (along < 0.45) {
    return use(-std::numbers::sqrt3, 1.0 / 6), use(0.0, 2.0 / 3), use(std::numbers::sqrt3, 1.0 / 6);
  }
  constexpr double kTexelsApart = 0.5;
  const double step = std::min(1.0, kTexelsApart / along);
  const int last = static_cast<int>(kReach / step);
  for (int i = -last; i <= last; ++i) use(i * step, std::exp(-0.5 * (i * step) * (i * step)));
}

}  // namespace

Rgba close_mean(Texels& texels, double x, double y, const Axes& axes, Smoothness smoothness) {
  const double round = std::clamp(std::sqrt(axes.minor), 1e-4, kLargestCloseSigma);
  const double along = std::sqrt(std::max(0.0, axes.major - axes.minor));
  WeightedSum total;
  for_each_point(along, [&](double point, double weight) {
    const Taps columns = taps_around(x + point * along * axes.x, round, smoothness.x);
    const Taps rows = taps_around(y + point * along * axes.y, round, smoothness.y);
    for (int i = 0; i < rows.count; ++i) {
      const auto by = static_cast<double>(rows.weights[static_cast<std::size_t>(i)]);
      total.add(weight * by, row_sum(texels, columns, rows.first + i));
    }
  });
  return total.mean();
}

}  // namespace lensplane
