// SPDX-License-Identifier: Apache-2.0
//
// The cubic B-spline: the one cubic that is smooth (twice differentiable), never negative, and gives ramps
// back as ramps. Catmull-Rom's cubic is sharper, but its negative weights ring: dark rings around stars.

#pragma once

#include <cmath>

namespace lensplane {

/// The second moment of cubic_spline.
inline constexpr double kCubicSplineVariance = 1.0 / 3.0;

/// The weight at distance `x`; 0 from 2 on. Its integral is 1, as is its sum over any x + integers.
inline double cubic_spline(double x) {
  const double distance = std::abs(x);
  if (distance >= 2) return 0;
  const double rest = 2 - distance;
  if (distance >= 1) return rest * rest * rest / 6;
  return 2.0 / 3.0 - distance * distance * (1 - distance / 2);
}

}  // namespace lensplane
