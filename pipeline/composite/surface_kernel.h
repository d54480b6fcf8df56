// SPDX-License-Identifier: Apache-2.0
//
// How much each texel counts along an axis when a narrow Gaussian is integrated over the surface between
// texels: the triangle of bilinear interpolation, or the cubic B-spline, convolved with the Gaussian.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "pipeline/composite/cubic_spline.h"

namespace lensplane {

/// Weights of the triangle convolved with Gaussians, for every standard deviation in steps of 1/256 texel.
class TriangleTable {
 public:
  static constexpr double kLargestSigma = 1.0;
  static constexpr int kSigmaSteps = 256;
  static constexpr int kPerTexel = 64;
  /// Standard deviations beyond the triangle that still count; a part in ten thousand lies beyond.
  static constexpr double kReach = 2.6;
  /// The last entries of every row are 0.
  static constexpr int kLength = static_cast<int>((1 + kReach * kLargestSigma) * kPerTexel) + 4;

  /// The one table; made at its first use.
  static const TriangleTable& get();

  /// The weights for a standard deviation up to kLargestSigma, by distance.
  const float* row(double sigma) const {
    return rows_[static_cast<std::size_t>(sigma * kSigmaSteps + 0.5)].data();
  }

 private:
  TriangleTable();

  std::array<std::array<float, kLength>, kSigmaSteps + 1> rows_;
};

/// The weights for one lookup along one axis.
class SurfaceKernel {
 public:
  /// `variance` of the Gaussian in texels, up to the square of TriangleTable::kLargestSigma; `smoothness`
  /// from 0, the triangle, to 1, the spline.
  SurfaceKernel(double variance, double smoothness)
      : sigma_(std::sqrt(variance < 1.0 ? variance : 1.0)),
        smoothness_(smoothness),
        row_(TriangleTable::get().row(sigma_)) {}

  /// Texels farther away have no weight.
  double reach() const {
    const double triangle = 1 + TriangleTable::kReach * sigma_;
    return smoothness_ > 0 && triangle < 2 + sigma_ ? 2 + sigma_ : triangle;
  }

  bool is_triangle() const { return smoothness_ == 0; }

  /// For a texel `distance` away, of a kernel that is_triangle().
  float triangle(float distance) const {
    constexpr auto kLast = static_cast<float>(TriangleTable::kLength - 2);
    const float place = std::min(std::abs(distance) * TriangleTable::kPerTexel, kLast);
    const auto i = static_cast<int>(place);
    return row_[i] + (row_[i + 1] - row_[i]) * (place - static_cast<float>(i));
  }

  /// For a texel `distance` away, of any kernel. The spline is smooth: two points stand for the Gaussian.
  float operator()(float distance) const {
    const float weight = triangle(distance);
    if (is_triangle()) return weight;
    const auto away = static_cast<double>(std::abs(distance));
    const double spline = 0.5 * (cubic_spline(away - sigma_) + cubic_spline(away + sigma_));
    return weight + static_cast<float>(smoothness_) * (static_cast<float>(spline) - weight);
  }

 private:
  double sigma_;
  double smoothness_;
  const float* row_;
};

}  // namespace lensplane
