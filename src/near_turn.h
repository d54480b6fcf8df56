// SPDX-License-Identifier: Apache-2.0
//
// Rotations by any angle, for loops over batches: sine and cosine without branches and library functions.

#pragma once

#include <bit>
#include <cstdint>
#include <numbers>

#include "src/inlining.h"
#include "src/rotation.h"

namespace lensplane {

/// Largest angle of near_turn, in radians: more than light is turned by that passes b_c in the last digit.
inline constexpr double kLongestTurn = 100.0;

/// Error of cosine and sine of near_turn.
inline constexpr double kNearTurnError = 4e-16;

/// Error of the slopes by q, as a share of their size at A = 0: just above kShortTurn differences of numbers
/// near 1 are divided by q.
inline constexpr double kNearSlopeError = 2e-13;

struct SineAndCosine {
  double sine;
  double cosine;
};

/// For 0 <= a <= kLongestTurn: quarter turns are taken away, then Taylor series for |r| <= pi/4.
LENSPLANE_ALWAYS_INLINE inline SineAndCosine sine_and_cosine(double a) {
  // Adding 1.5 2^52 rounds to an integer, which then stands in the lowest bits.
  constexpr double kRound = 6755399441055744.0;
  const double shifted = a * (2.0 / std::numbers::pi) + kRound;
  const double quarters = shifted - kRound;
  const auto bits = std::bit_cast<std::uint64_t>(shifted);
  // pi/2 in two parts (Cody and Waite); the first has so few digits that its product is exact.
  constexpr double kHalfPiHigh = 1.5707963267341256;
  constexpr double kHalfPiLow = 6.077100506506192e-11;
  const double r = (a - quarters * kHalfPiHigh) - quarters * kHalfPiLow;
  const double q = r * r;
  constexpr std::array kSine = {1.0,
                                -1.0 / 6.0,
                                1.0 / 120.0,
                                -1.0 / 5040.0,
                                1.0 / 362880.0,
                                -1.0 / 39916800.0,
                                1.0 / 6227020800.0,
                                -1.0 / 1307674368000.0};
  constexpr std::array kCosine = {1.0,
                                  -1.0 / 2.0,
                                  1.0 / 24.0,
                                  -1.0 / 720.0,
                                  1.0 / 40320.0,
                                  -1.0 / 3628800.0,
                                  1.0 / 479001600.0,
                                  -1.0 / 87178291200.0,
                                  1.0 / 20922789888000.0};
  const double sine = r * polynomial(kSine, q).value;
  const double cosine = polynomial(kCosine, q).value;
  const bool odd = (bits & 1) != 0;
  const double s = odd ? cosine : sine;
  const double c = odd ? sine : cosine;
  return {(bits & 2) != 0 ? -s : s, ((bits + 1) & 2) != 0 ? -c : c};
}

/// The rotation by the angle sqrt(q), for 0 <= q <= kLongestTurn^2.
template <class Number>
LENSPLANE_ALWAYS_INLINE inline Turn<Number> near_turn(const Number& q) {
  const double q0 = value_of(q);
  const bool is_short = q0 <= kShortTurn * kShortTurn;
  const Turn<double> small = short_turn(is_short ? q0 : 0.0);
  const double safe = is_short ? 1.0 : q0;
  const double a = std::sqrt(safe);
  const double per_q = 1.0 / safe;
  const SineAndCosine whole = sine_and_cosine(a);
  const SineAndCosine half = sine_and_cosine(0.5 * a);
  const double cosine = is_short ? small.cosine : whole.cosine;
  const double sine = is_short ? small.sine : whole.sine * (a * per_q);
  const double versine = is_short ? small.versine : 2.0 * half.sine * half.sine * per_q;
  // Slopes by q: for short turns from the series, dS/dq = -1/6 + q/60 ..., dE/dq = -1/24 + q/360 ...
  constexpr std::array kSineSlope = {-1.0 / 6.0, 2.0 / 120.0, -3.0 / 5040.0, 4.0 / 362880.0};
  constexpr std::array kVersineSlope = {-1.0 / 24.0, 2.0 / 720.0, -3.0 / 40320.0, 4.0 / 3628800.0};
  const double sine_slope = is_short ? polynomial(kSineSlope, q0).value : 0.5 * (cosine - sine) * per_q;
  const double versine_slope =
      is_short ? polynomial(kVersineSlope, q0).value : (0.5 * sine - versine) * per_q;
  return {chained(q, cosine, -0.5 * sine), chained(q, sine, sine_slope), chained(q, versine, versine_slope)};
}

}  // namespace lensplane
