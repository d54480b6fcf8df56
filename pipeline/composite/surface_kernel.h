// SPDX-License-Identifier: Apache-2.0
//
// How much each texel counts along an axis when a narrow Gaussian is integrated over the surface between
// texels: Catmull-Rom's cubic, convolved with the Gaussian.
//
// The cubic goes through the texels, is smooth, gives parabolas back as they are, and so adds no variance of
// its own: under no filter at all a texel's centre is the texel. Its negative lobes, which ring beside
// highlights, are limited by local_range.h; under Gaussians that are wide enough to hide them they are left
// out.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "src/inlining.h"

namespace lensplane {

/// What the cubic takes from fine detail that is seen through a Gaussian of this variance, in texels, as the
/// variance of a Gaussian that takes as much: for filters that sum up texels and know no surface. The wider
/// the Gaussian, the coarser what passes it, and the less the cubic takes from that.
inline double surface_variance(double variance) {
  return 0.05 * std::min(1.0, 0.5 / variance);
}

/// From this variance of the Gaussian on no weight is negative.
inline constexpr double kNoLobesVariance = 1.0;

/// The weights of eight texels side by side: of all that a kernel reaches.
struct alignas(32) Taps {
  static constexpr int kCount = 8;
  float weight[kCount];
};

/// Kernels for every standard deviation in steps of 1/256 texel, for places in steps of 1/64.
class KernelTable {
 public:
  static constexpr double kLargestSigma = 1.0;
  static constexpr int kSigmaSteps = 256;
  static constexpr int kPlaces = 64;
  /// Texels from a place to the farthest that still counts, at most.
  static constexpr int kReach = 3;

  /// The one table; made at its first use.
  static const KernelTable& get();

  /// By the place between two texels: kPlaces + 1 of them, the weights of texels side by side; they sum up
  /// to 1.
  const Taps* taps(double sigma) const { return taps_[step(sigma)].data(); }
  /// By the distance of a texel, up to kReach; 0 from there on.
  const float* weights(double sigma) const { return weights_[step(sigma)].data(); }

  /// The same of kernels that have been convolved with the cubic once more.
  const Taps* twice_taps(double sigma) const { return twice_taps_[step(sigma)].data(); }
  const float* twice_weights(double sigma) const { return twice_weights_[step(sigma)].data(); }

 private:
  KernelTable();

  static std::size_t step(double sigma) { return static_cast<std::size_t>(sigma * kSigmaSteps + 0.5); }

  using OfPlaces = std::array<Taps, kPlaces + 1>;
  using OfDistances = std::array<float, kReach * kPlaces + 2>;
  static OfPlaces by_place(const OfDistances& weights);
  static OfDistances twice(const OfDistances& weights);

  std::array<OfPlaces, kSigmaSteps + 1> taps_, twice_taps_;
  std::array<OfDistances, kSigmaSteps + 1> weights_, twice_weights_;
};

/// The weights for one lookup along one axis.
class SurfaceKernel {
 public:
  /// `variance` of the Gaussian in texels, up to the square of KernelTable::kLargestSigma. `slant`: how far
  /// the kernel's middle moves from row to row where rows are summed up, 0 to 1. The cubic across the rows is
  /// seen through it as a cubic of that width along them; it is held as a share of one that is as wide as
  /// texels, which takes as much from fine detail within a fiftieth.
  explicit SurfaceKernel(double variance, double slant = 0)
      : sigma_(std::sqrt(std::clamp(variance, 0.0, KernelTable::kLargestSigma * KernelTable::kLargestSigma))),
        taps_(KernelTable::get().taps(sigma_)),
        weights_(KernelTable::get().weights(sigma_)),
        twice_share_(static_cast<float>(std::min(1.0, slant * slant * slant))),
        twice_taps_(KernelTable::get().twice_taps(sigma_)),
        twice_weights_(KernelTable::get().twice_weights(sigma_)) {}

  /// Texels farther away have no weight that counts.
  double reach() const { return twice_share_ > 0 ? KernelTable::kReach : reach(sigma_); }
  static double reach(double sigma) {
    return std::min(2 + 2.6 * sigma, static_cast<double>(KernelTable::kReach));
  }

  /// For the texels number kFirstTap to kFirstTap + Taps::kCount - 1 from the one before a place that lies
  /// `share` of the way to the next, 0 to 1.
  static constexpr int kFirstTap = -3;
  LENSPLANE_ALWAYS_INLINE Taps taps(float share) const {
    const float place = share * KernelTable::kPlaces;
    const int i = std::min(static_cast<int>(place), KernelTable::kPlaces - 1);
    const float rest = place - static_cast<float>(i);
    Taps taps = between(taps_[i], taps_[i + 1], rest);
    if (twice_share_ > 0)
      taps = between(taps, between(twice_taps_[i], twice_taps_[i + 1], rest), twice_share_);
    return taps;
  }

  /// For a texel `distance` away.
  LENSPLANE_ALWAYS_INLINE float operator()(float distance) const {
    constexpr int kEnd = KernelTable::kReach * KernelTable::kPlaces;
    const float away = std::abs(distance) * KernelTable::kPlaces;
    const float place = away < kEnd ? away : static_cast<float>(kEnd);
    const int i = static_cast<int>(place);
    const float rest = place - static_cast<float>(i);
    const float once = weights_[i] + (weights_[i + 1] - weights_[i]) * rest;
    const float twice = twice_weights_[i] + (twice_weights_[i + 1] - twice_weights_[i]) * rest;
    return once + twice_share_ * (twice - once);
  }

  /// Multiplies `weights` by what texels weigh that lie `first`, `first + step`, ... away.
  LENSPLANE_ALWAYS_INLINE void weigh(float first, float step, int count, float* weights) const {
    for (int n = 0; n < count; ++n) weights[n] *= (*this)(first + step * static_cast<float>(n));
  }

 private:
  LENSPLANE_ALWAYS_INLINE static Taps between(const Taps& a, const Taps& b, float share) {
    Taps taps;
    for (int n = 0; n < Taps::kCount; ++n) {
      taps.weight[n] = a.weight[n] + (b.weight[n] - a.weight[n]) * share;
    }
    return taps;
  }

  double sigma_;
  const Taps* taps_;
  const float* weights_;
  float twice_share_;
  const Taps* twice_taps_;
  const float* twice_weights_;
};

}  // namespace lensplane
