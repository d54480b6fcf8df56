// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/surface_kernel.h"

#include <numbers>

namespace lensplane {
namespace {

/// The expectations of (x - u)^2/2 and (x - u)^3/6 where they are positive, u normally distributed with
/// deviation sigma.
struct Powers {
  double square, cube;
};
Powers powers_at(double x, double sigma) {
  if (sigma == 0) {
    const double y = std::max(x, 0.0);
    return {y * y / 2, y * y * y / 6};
  }
  const double z = x / sigma, variance = sigma * sigma;
  const double below = std::erfc(-z / std::numbers::sqrt2) / 2;
  const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi) * sigma;
  return {((x * x + variance) * below + x * density) / 2,
          ((x * x + 3 * variance) * x * below + (x * x + 2 * variance) * density) / 6};
}

/// The cubic is made of pieces: where they meet, its second and third derivatives jump.
struct Knot {
  double place, second, third;
};
constexpr std::array kKnots = {Knot{-2, -1, 3}, Knot{-1, 2, -12}, Knot{0, 0, 18}, Knot{1, -2, -12},
                               Knot{2, 1, 3}};

/// The share of the negative lobes that is kept: the wider the Gaussian, the less there is of them.
double share_of_lobes(double variance) {
  constexpr double kAll = 0.5, kNone = kNoLobesVariance;
  const double way = std::clamp((variance - kAll) / (kNone - kAll), 0.0, 1.0);
  return 1 - way * way * (3 - 2 * way);
}

/// From the left, where the sum's terms are small.
double weight_at(double distance, double sigma) {
  if (distance > SurfaceKernel::reach(sigma)) return 0;
  double weight = 0;
  for (const Knot& knot : kKnots) {
    const Powers powers = powers_at(-distance - knot.place, sigma);
    weight += knot.second * powers.square + knot.third * powers.cube;
  }
  return weight < 0 ? weight * share_of_lobes(sigma * sigma) : weight;
}

void normalise(Taps& taps) {
  double sum = 0;
  for (const float weight : taps.weight) sum += static_cast<double>(weight);
  for (float& weight : taps.weight) weight = static_cast<float>(static_cast<double>(weight) / sum);
}

}  // namespace

const KernelTable& KernelTable::get() {
  static const KernelTable table;
  return table;
}

KernelTable::OfPlaces KernelTable::by_place(const OfDistances& weights) {
  OfPlaces places;
  for (int place = 0; place <= kPlaces; ++place) {
    Taps& taps = places[static_cast<std::size_t>(place)];
    for (int n = 0; n < Taps::kCount; ++n) {
      const int distance = std::abs((n + SurfaceKernel::kFirstTap) * kPlaces - place);
      taps.weight[n] = weights[static_cast<std::size_t>(std::min(distance, kReach * kPlaces))];
    }
    normalise(taps);
  }
  return places;
}

/// Both are sampled finely enough for their integral to be a sum.
KernelTable::OfDistances KernelTable::twice(const OfDistances& weights) {
  constexpr int kEvery = 8, kEnd = kReach * kPlaces;
  OfDistances result{};
  for (int i = 0; i < kEnd; ++i) {
    double sum = 0;
    for (int k = -2 * kPlaces; k <= 2 * kPlaces; k += kEvery) {
      const auto distance = static_cast<std::size_t>(std::min(std::abs(i - k), kEnd));
      sum +=
          weight_at(std::abs(k) / static_cast<double>(kPlaces), 0) * static_cast<double>(weights[distance]);
    }
    result[static_cast<std::size_t>(i)] = static_cast<float>(sum * kEvery / kPlaces);
  }
  return result;
}

KernelTable::KernelTable() {
  constexpr int kEnd = kReach * kPlaces;
  for (std::size_t step = 0; step < weights_.size(); ++step) {
    const double sigma = static_cast<double>(step) / kSigmaSteps;
    for (int i = 0; i <= kEnd + 1; ++i) {
      weights_[step][static_cast<std::size_t>(i)] =
          i < kEnd ? static_cast<float>(weight_at(static_cast<double>(i) / kPlaces, sigma)) : 0.0F;
    }
    taps_[step] = by_place(weights_[step]);
    twice_weights_[step] = twice(weights_[step]);
    twice_taps_[step] = by_place(twice_weights_[step]);
  }
}

}  // namespace lensplane
