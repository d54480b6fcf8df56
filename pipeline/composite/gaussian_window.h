// SPDX-License-Identifier: Apache-2.0
//
// A Gaussian that ends: exp(-q/2) up to q = kCut, taken down to nothing there so that texels come and go
// smoothly. It is taken down at its rim only: lowered as a whole it would be a percent too flat in the
// middle, which shows at every edge.

#pragma once

namespace lensplane {

/// q at the window's edge: 3.5 standard deviations.
inline constexpr float kCut = 12;

/// exp(-q/2) for q in [0, kCut] within 4e-4 of itself, for a number or several at once: the exponential
/// series of a sixteenth, four times squared.
template <class Number>
constexpr Number gaussian(Number q) {
  const Number z = q * (1.0F / 32);
  Number power = 1.0F - z * (1.0F - z * (0.5F - z * (1.0F / 6 - z * (1.0F / 24))));
  power *= power;
  power *= power;
  power *= power;
  return power * power;
}

inline constexpr float kEdgeWeight = gaussian(kCut);

/// The window at q in [0, kCut]: 1 in the middle, 0 at the edge but for rounding.
template <class Number>
constexpr Number windowed_gaussian(Number q) {
  const Number share = q * (1.0F / kCut), square = share * share;
  return gaussian(q) - kEdgeWeight * (square * square);
}

/// How much narrower than its Gaussian the window is taken for, in variance: so that lines and edges under it
/// come nearest to what the whole Gaussian makes of them, to 0.0011 of an edge's height. (Its second moment,
/// which the far tails determine, is 0.973.)
inline constexpr double kVarianceLeft = 0.992;

}  // namespace lensplane
