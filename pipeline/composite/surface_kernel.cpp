// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/surface_kernel.h"

#include <algorithm>
#include <numbers>

namespace lensplane {
namespace {

/// The second integral of the normal distribution's density of width sigma; of nothing, the ramp.
double ramp_integral(double x, double sigma) {
  if (sigma == 0) return std::max(x, 0.0);
  const double z = x / sigma;
  const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
  return sigma * (z * std::erfc(-z / std::numbers::sqrt2) / 2 + density);
}

/// The triangle is the second difference of ramps; it ends at its reach.
double weight_at(double distance, double sigma) {
  if (distance > 1 + TapTable::kReach * sigma + 1.0 / TapTable::kPlaces) return 0;
  return std::max(0.0, ramp_integral(distance - 1, sigma) - 2 * ramp_integral(distance, sigma) +
                           ramp_integral(distance + 1, sigma));
}

}  // namespace

const TapTable& TapTable::get() {
  static const TapTable table;
  return table;
}

TapTable::TapTable() {
  for (std::size_t step = 0; step < rows_.size(); ++step) {
    const double sigma = static_cast<double>(step) / kSigmaSteps;
    std::array<float, 4 * kPlaces + 1> by_distance;
    for (std::size_t i = 0; i < by_distance.size(); ++i) {
      by_distance[i] = static_cast<float>(weight_at(static_cast<double>(i) / kPlaces, sigma));
    }
    for (int place = 0; place <= kPlaces; ++place) {
      for (int n = 0; n < Taps::kCount; ++n) {
        const int distance = std::abs((n + SurfaceKernel::kFirstTap) * kPlaces - place);
        rows_[step][static_cast<std::size_t>(place)].weight[n] =
            by_distance[static_cast<std::size_t>(distance)];
      }
    }
  }
}

}  // namespace lensplane
