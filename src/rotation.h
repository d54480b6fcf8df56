// SPDX-License-Identifier: Apache-2.0
//
// The three numbers of a rotation by an angle A, as functions of q = A^2: smooth at A = 0, where cos(A) and
// sin(A)/A of an angle that comes as the length of a vector would have no derivatives.

#pragma once

#include <array>
#include <cmath>

#include "src/dual.h"
#include "src/exact_law.h"
#include "src/inlining.h"

namespace lensplane {

template <class Number>
struct Turn {
  Number cosine;   // C = cos A
  Number sine;     // S = sin(A)/A
  Number versine;  // E = (1 - cos A)/A^2
};

/// Largest angle of short_turn, in radians; its remainders are below 1e-16.
inline constexpr double kShortTurn = 0.15;

/// By the Taylor series, without a branch. 0 <= q <= kShortTurn^2.
template <class Number>
LENSPLANE_ALWAYS_INLINE inline Turn<Number> short_turn(const Number& q) {
  constexpr std::array kSine = {1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362880.0};
  constexpr std::array kVersine = {1.0 / 2.0, -1.0 / 24.0, 1.0 / 720.0, -1.0 / 40320.0, 1.0 / 3628800.0};
  const ValueAndSlope s = polynomial(kSine, value_of(q));
  const ValueAndSlope e = polynomial(kVersine, value_of(q));
  const Number versine = chained(q, e.value, e.slope);
  return {Number(1.0) - q * versine, chained(q, s.value, s.slope), versine};
}

/// By the library's sine and cosine, for any q >= 0.
template <class Number>
Turn<Number> turn(const Number& q) {
  if (value_of(q) <= kShortTurn * kShortTurn) return short_turn(q);
  const double a = std::sqrt(value_of(q));
  const double cosine = std::cos(a);
  const double sine = std::sin(a) / a;
  const double half = std::sin(a / 2.0);
  const double versine = 2.0 * half * half / value_of(q);
  // dC/dq = -S/2, dS/dq = (C - S)/(2 q), dE/dq = (S/2 - E)/q
  return {chained(q, cosine, -sine / 2.0), chained(q, sine, (cosine - sine) / (2.0 * value_of(q))),
          chained(q, versine, (sine / 2.0 - versine) / value_of(q))};
}

}  // namespace lensplane
