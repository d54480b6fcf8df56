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
#include "src/inlining.h"

namespace lensplane {

/// What a Gaussian of width 1 adds to the ramp max(z, 0) where it rounds the kink off: phi(z) - z Q(z) of z
/// >= 0, within kKinkError. Without branches, for loops.
LENSPLANE_ALWAYS_INLINE inline float rounded_kink(float z) {
  constexpr float kReach = 3.2F;
  const float u = z * (2 / kReach) - 1;
  const float value =
      0.0232269F +
      u * (-0.0874942F +
           u * (0.1424674F + u * (-0.1228117F + u * (0.0447663F + u * (0.0109084F - u * 0.0109114F)))));
  return z < kReach && value > 0 ? value : 0.0F;
}
inline constexpr double kKinkError = 2e-4;

/// The weights of eight texels side by side: of all that a kernel reaches.
struct alignas(32) Taps {
  static constexpr int kCount = 8;
  float weight[kCount];
};

/// Taps of the triangle convolved with Gaussians, for every standard deviation in steps of 1/256 texel and
/// for each place between two texels in steps of 1/64.
class TapTable {
 public:
  static constexpr double kLargestSigma = 1.0;
  static constexpr int kSigmaSteps = 256;
  static constexpr int kPlaces = 64;
  /// Standard deviations beyond the triangle that still count; a part in ten thousand lies beyond.
  static constexpr double kReach = 2.6;

  /// The one table; made at its first use.
  static const TapTable& get();

  /// For a standard deviation up to kLargestSigma, by place: kPlaces + 1 of them.
  const Taps* row(double sigma) const {
    return rows_[static_cast<std::size_t>(sigma * kSigmaSteps + 0.5)].data();
  }

 private:
  TapTable();

  std::array<std::array<Taps, kPlaces + 1>, kSigmaSteps + 1> rows_;
};

/// The weights for one lookup along one axis.
class SurfaceKernel {
 public:
  /// `variance` of the Gaussian in texels, up to the square of TapTable::kLargestSigma; `smoothness` from 0,
  /// the triangle, to 1, the spline.
  SurfaceKernel(double variance, double smoothness)
      : sigma_(std::sqrt(variance < 1.0 ? variance : 1.0)),
        smoothness_(smoothness),
        taps_(TapTable::get().row(sigma_)) {}

  /// Texels farther away have no weight that counts.
  double reach() const {
    const double triangle = 1 + TapTable::kReach * sigma_;
    return smoothness_ > 0 && triangle < 2 + sigma_ ? 2 + sigma_ : triangle;
  }

  /// For the texels number kFirstTap to kFirstTap + Taps::kCount - 1 from the one before a place that lies
  /// `share` of the way to the next, 0 to 1.
  static constexpr int kFirstTap = -3;
  LENSPLANE_ALWAYS_INLINE Taps taps(float share) const {
    const float place = share * TapTable::kPlaces;
    const int i = std::min(static_cast<int>(place), TapTable::kPlaces - 1);
    const Taps &before = taps_[i], &after = taps_[i + 1];
    const float rest = place - static_cast<float>(i);
    Taps taps;
    for (int n = 0; n < Taps::kCount; ++n) {
      taps.weight[n] = before.weight[n] + (after.weight[n] - before.weight[n]) * rest;
    }
    if (smoothness_ == 0) return taps;
    for (int n = 0; n < Taps::kCount; ++n) {
      taps.weight[n] = partly_spline(taps.weight[n], static_cast<float>(n + kFirstTap) - share);
    }
    return taps;
  }

  /// For a texel `distance` away. Ramps with their kinks rounded off make up the triangle.
  LENSPLANE_ALWAYS_INLINE float operator()(float distance) const {
    const float triangle = narrow_triangle(distance) + far_kink(distance);
    return smoothness_ == 0 ? triangle : partly_spline(triangle, distance);
  }

  /// Multiplies `weights` by what texels weigh that lie `first`, `first + step`, ... away.
  LENSPLANE_ALWAYS_INLINE void weigh(float first, float step, int count, float* weights) const {
    if (smoothness_ == 0 && sigma_ < kNarrow) {
      for (int n = 0; n < count; ++n) weights[n] *= narrow_triangle(first + step * static_cast<float>(n));
    } else {
      for (int n = 0; n < count; ++n) weights[n] *= (*this)(first + step * static_cast<float>(n));
    }
  }

 private:
  // Gaussians below this do not reach from one end of the triangle beyond its middle to the other.
  static constexpr double kNarrow = 0.3;

  float sigma() const { return std::max(static_cast<float>(sigma_), 1e-6F); }

  /// As if the kinks at the triangle's middle and at one of its ends were all; never negative.
  LENSPLANE_ALWAYS_INLINE float narrow_triangle(float distance) const {
    const float away = std::abs(distance), per_sigma = 1 / sigma();
    const float kinks = rounded_kink(std::abs(away - 1) * per_sigma) - 2 * rounded_kink(away * per_sigma);
    const float weight = (away < 1 ? 1 - away : 0.0F) + sigma() * kinks;
    return weight > 0 ? weight : 0.0F;
  }
  /// What that at the other end adds.
  LENSPLANE_ALWAYS_INLINE float far_kink(float distance) const {
    return sigma() * rounded_kink((std::abs(distance) + 1) / sigma());
  }

  /// The spline is smooth: two points stand for the Gaussian.
  LENSPLANE_ALWAYS_INLINE float partly_spline(float triangle, float distance) const {
    const auto sigma = static_cast<float>(sigma_);
    const float spline = 0.5F * (cubic_spline(distance - sigma) + cubic_spline(distance + sigma));
    return triangle + static_cast<float>(smoothness_) * (spline - triangle);
  }

  double sigma_;
  double smoothness_;
  const Taps* taps_;
};

}  // namespace lensplane
