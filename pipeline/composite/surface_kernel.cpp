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

/// The triangle is the second difference of ramps.
double weight_at(double distance, double sigma) {
  return ramp_integral(distance - 1, sigma) - 2 * ramp_integral(distance, sigma) +
         ramp_integral(distance + 1, sigma);
}

}  // namespace

const TriangleTable& TriangleTable::get() {
  static const TriangleTable table;
  return table;
}

TriangleTable::TriangleTable() {
  for (int step = 0; step <= kSigmaSteps; ++step) {
    const double sigma = static_cast<double>(step) / kSigmaSteps;
    for (int i = 0; i < kLength; ++i) {
      const double distance = static_cast<double>(i) / kPerTexel;
      const bool within = distance <= 1 + kReach * sigma + 1.0 / kPerTexel;
      rows_[static_cast<std::size_t>(step)][static_cast<std::size_t>(i)] =
          within ? static_cast<float>(std::max(0.0, weight_at(distance, sigma))) : 0.0F;
    }
  }
}

}  // namespace lensplane
