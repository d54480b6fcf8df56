// SPDX-License-Identifier: Apache-2.0
//
// The exact deflection of light by one static mass (Schwarzschild; C. Darwin 1959), as polynomials.
//
// Darwin's angle is an elliptic integral of x = b_c/b, 0 <= x < 1. docs/exact-law-fit.py fits it in 70
// digits:
//
//   near:  alpha = x A(x) - B(x) ln(1 - x)   everywhere;      worst relative error of the fit 8.2e-18
//   far:   alpha = x F(x)                    x <= kFarRatio;                                  1.1e-16
//
// A and B are written in powers of x - 1/2: their terms fall fast, and no digits are lost to cancellation.
//
// Everything here is for loops over batches (batch.h): no branches and no library functions, only additions,
// multiplications, divisions and operations on bits, so that every instruction set gives the same bits.

#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include "src/deflection.h"
#include "src/dual.h"
#include "src/inlining.h"

namespace lensplane {

inline constexpr std::array kNearA = {-0.55018509646371,   0.46297993501664647,    -0.5216807911438964,
                                      0.6081072942795802,  -0.6300662539197425,    0.5232537237401774,
                                      -0.3224783840541206, 0.13711304890726178,    -0.03665360029638281,
                                      0.0052910933320528,  -0.0002974504114284529, 1.4313961875754354e-06};

inline constexpr std::array kNearB = {1.2003268396374975,   -0.5943109784779983,   0.6136850358031628,
                                      -0.7119675178228569,  0.7717340562590231,    -0.6985191140125677,
                                      0.48873744791833856,  -0.24791030898825245,  0.08496856086735607,
                                      -0.01781872074377105, 0.0019250059462176115, -7.229447423117849e-05};

// The integral of what the exact angle is more than the weak law, from b to infinity: b_c times
//
//   g(x) = x A'(x) - B'(x) (1 - x) ln(1 - x),   worst error of the fit 1.4e-14 x.

inline constexpr std::array kDelayA = {
    2.0542779872224015, -4.604040400468145, 8.291601564693288,   -11.607120389423171, 11.973202317124931,
    -8.617510202533799, 4.049203276520545,  -1.1224206605093867, 0.15206927712599685, -0.006350568414413598};

inline constexpr std::array kDelayB = {
    -2.1833865037927147, 4.633250514399737,  -7.855560886885403, 10.11004932591156,    -9.335848545058054,
    5.844099636943217,   -2.306801352978639, 0.5119064512953052, -0.05129319656998502, 0.0013256286977209799};

/// Up to which x = b_c/b the far form holds: from b = 34.6 m on.
inline constexpr double kFarRatio = 0.15;

inline constexpr std::array kFar = {0.769800358919501,   0.4363323129984985,  0.3041186603406713,
                                    0.23331658106166353, 0.18922955178466774, 0.15913982289952705,
                                    0.1374086316634572,  0.11952094023838697, 0.11719092488268323,
                                    0.05309003291238731, 0.19712168977683409};

/// Relative errors: of alpha = x F(x) and of its derivative for x <= kFarRatio, and of log_of_share.
/// near_exact's is kExactLawError.
inline constexpr double kFarError = 1e-15;
inline constexpr double kFarSlopeError = 1e-13;
inline constexpr double kLogError = 1e-15;

struct ValueAndSlope {
  double value;
  double slope;
};

/// A polynomial, lowest power first, by Estrin's scheme: pairs of terms first, which wait for one another
/// less than Horner's one after the other do.
template <std::size_t terms>
LENSPLANE_ALWAYS_INLINE constexpr double polynomial_value(const std::array<double, terms>& c, double x) {
  if constexpr (terms == 1) {
    return c[0];
  } else {
    const auto halved = [&]<std::size_t... i>(std::index_sequence<i...>) LENSPLANE_ALWAYS_INLINE {
      return std::array<double, (terms + 1) / 2>{
          (2 * i + 1 < terms ? c[2 * i] + c[std::min(2 * i + 1, terms - 1)] * x : c[2 * i])...};
    };
    return polynomial_value(halved(std::make_index_sequence<(terms + 1) / 2>()), x * x);
  }
}

/// The derivative's coefficients.
template <std::size_t terms>
constexpr std::array<double, terms - 1> derivative_of(const std::array<double, terms>& c) {
  std::array<double, terms - 1> d{};
  for (std::size_t i = 1; i < terms; ++i) d[i - 1] = static_cast<double>(i) * c[i];
  return d;
}

/// A polynomial and its derivative at x.
template <std::size_t terms>
LENSPLANE_ALWAYS_INLINE constexpr ValueAndSlope polynomial(const std::array<double, terms>& c, double x) {
  return {polynomial_value(c, x), polynomial_value(derivative_of(c), x)};
}

/// F(x) for x = b_c/b <= kFarRatio, where alpha = x F(x). F(0) = 4/kCriticalRatio is the weak law.
template <class Number>
LENSPLANE_ALWAYS_INLINE constexpr Number far_exact_ratio(const Number& x) {
  const ValueAndSlope f = polynomial(kFar, value_of(x));
  return chained(x, f.value, f.slope);
}

/// ln(u) for u = 1 - x, given both because neither holds the other's last digits. Relative error kLogError
/// for 1e-300 <= u <= 1e300, on both sides of 1; some number without meaning for other u.
LENSPLANE_ALWAYS_INLINE inline double log_of_share(double x, double u) {
  // u = 2^k f with f in [sqrt(1/2), sqrt(2)): k stands in the bits of u above the 52 of the mantissa.
  constexpr auto kRootHalf = std::bit_cast<std::uint64_t>(0.5 * std::numbers::sqrt2);
  constexpr std::uint64_t kShift = std::bit_cast<std::uint64_t>(1.0) - kRootHalf;
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;
  constexpr double kTwoTo52 = 4503599627370496.0;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(u) + kShift;
  const double f = std::bit_cast<double>((bits & kMantissa) + kRootHalf);
  const double k =
      std::bit_cast<double>((bits >> 52) | std::bit_cast<std::uint64_t>(kTwoTo52)) - (kTwoTo52 + 1023.0);
  const double g = k == 0.0 ? -x : f - 1.0;

  // ln(f) = 2 atanh(s) with s = (f - 1)/(f + 1), |s| < 0.172: the series' remainder is below 3e-17.
  constexpr std::array kAtanh = {2.0,        2.0 / 3.0,  2.0 / 5.0,  2.0 / 7.0,  2.0 / 9.0,
                                 2.0 / 11.0, 2.0 / 13.0, 2.0 / 15.0, 2.0 / 17.0, 2.0 / 19.0};
  const double s = g / (2.0 + g);
  return k * std::numbers::ln2 + s * polynomial(kAtanh, s * s).value;
}

/// b_c = 3 sqrt(3) m as an unevaluated sum: close to b_c the difference b - b_c needs more digits of it than
/// one number holds.
struct CriticalRadius {
  double b_c;   // kCriticalRatio m, rounded
  double rest;  // what is missing
};

LENSPLANE_ALWAYS_INLINE constexpr CriticalRadius critical_radius(double m) {
  // Products of half as long factors are exact (Dekker 1971). kRest = 3 sqrt(3) - kCriticalRatio.
  constexpr std::uint64_t kUpperHalf = ~((std::uint64_t{1} << 27) - 1);
  constexpr double kHigh = std::bit_cast<double>(std::bit_cast<std::uint64_t>(kCriticalRatio) & kUpperHalf);
  constexpr double kLow = kCriticalRatio - kHigh;
  constexpr double kRest = -1.4303668319585554e-16;
  const double high = std::bit_cast<double>(std::bit_cast<std::uint64_t>(m) & kUpperHalf);
  const double low = m - high;
  const double b_c = kCriticalRatio * m;
  return {b_c, (((high * kHigh - b_c) + low * kHigh) + high * kLow) + low * kLow + kRest * m};
}

/// The impact parameter as a share of the way from infinity to the photon sphere.
struct Shares {
  double x;  // b_c/b
  double u;  // 1 - x, to its own last digit
};

LENSPLANE_ALWAYS_INLINE constexpr Shares shares_of(double m, double b) {
  const CriticalRadius critical = critical_radius(m);
  const double per_b = 1.0 / b;
  return {critical.b_c * per_b, ((b - critical.b_c) - critical.rest) * per_b};
}

/// g(x)/x far away: kFar, whose first term is the weak law, integrated term by term.
inline constexpr auto kDelayFar = [] {
  std::array<double, kFar.size() - 1> c{};
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = kFar[i + 1] / static_cast<double>(i + 1);
  return c;
}();

/// What the exact angle is more than 4 m/b, integrated from b to infinity, in metres; 0 for b <= b_c.
LENSPLANE_ALWAYS_INLINE inline double exact_excess_beyond(double m, double b) {
  const auto [x, u] = shares_of(m, b);
  const double share = u > 0.0 ? u : 1.0;
  const double a_of = polynomial_value(kDelayA, x - 0.5), b_of = polynomial_value(kDelayB, x - 0.5);
  const double near = x * a_of - b_of * share * log_of_share(1.0 - share, share);
  const double far = x * polynomial_value(kDelayFar, x);
  return u > 0.0 ? kCriticalRatio * m * (x <= kFarRatio ? far : near) : 0.0;
}

/// The exact angle and its derivative for b > kCriticalRatio m; for smaller b some numbers without meaning.
/// In a loop over b the compiler computes what depends on m alone once.
LENSPLANE_ALWAYS_INLINE inline Deflection near_exact(double m, double b) {
  const auto [x, u] = shares_of(m, b);
  const double log_u = log_of_share(x, u);
  const ValueAndSlope a_of = polynomial(kNearA, x - 0.5);
  const ValueAndSlope b_of = polynomial(kNearB, x - 0.5);
  const double alpha = x * a_of.value - b_of.value * log_u;
  const double dalpha_dx = a_of.value + x * a_of.slope - b_of.slope * log_u + b_of.value / u;
  return {alpha, -x * (1.0 / b) * dalpha_dx};
}

}  // namespace lensplane
