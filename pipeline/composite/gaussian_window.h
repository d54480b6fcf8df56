// SPDX-License-Identifier: Apache-2.0
//
// A Gaussian that ends: exp(-q/2) up to q = kCut, lowered by what it is there so that texels come and go
// smoothly.

#pragma once

namespace lensplane {

/// q at the window's edge: 3.2 standard deviations.
inline constexpr float kCut = 10;

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

/// What ending at kCut and lowering leave of the variance: with H = kCut/2 and e = exp(-H),
/// (1 - e (1 + H + H^2/2)) / (1 - e (1 + H)) = 0.9123. It is for two dimensions, as ellipses are summed up.
inline constexpr double kVarianceLeft = 0.91225;

}  // namespace lensplane
