// SPDX-License-Identifier: Apache-2.0
//
// The cubic B-spline: the one cubic that is smooth (twice differentiable), never negative, and gives ramps
// back as ramps. Catmull-Rom's cubic is sharper, but its negative weights ring: dark rings around stars.

#pragma once

namespace lensplane {

/// The second moment of cubic_spline.
inline constexpr double kCubicSplineVariance = 1.0 / 3.0;

/// The weight at distance `x`; 0 from 2 on. Its integral is 1, as is its sum over any x + integers.
template <class Number>
constexpr Number cubic_spline(Number x) {
  const Number distance = x < 0 ? -x : x;
  const Number outer = distance < 2 ? 2 - distance : Number(0);
  const Number inner = distance < 1 ? 1 - distance : Number(0);
  return (outer * outer * outer - 4 * inner * inner * inner) / 6;
}

}  // namespace lensplane
