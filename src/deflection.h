// SPDX-License-Identifier: Apache-2.0
//
// Deflection laws: how far does one static mass bend a ray?
//
// A law gives alpha(b), the angle in radians between a ray's two asymptotes, for impact parameter b and
// geometric mass m = G M / c^2 in the same unit of length. Everything about the laws stands in one table,
// kLaws. Only m/b counts: alpha(k m, k b) = alpha(m, b).
//
// How far the weaker laws are off follows from the exact angle's series. With x = b_c/b, b_c = 3 sqrt(3) m,
//
//   alpha = sum of a_n (m/b)^n = sum of (d_n/n) x^n,  n = 1, 2, ...
//   a_n = sqrt(pi) 2^n Gamma((3n + 1)/2)/(n! Gamma(n/2 + 1)) = 4, 15 pi/4, 128/3, 3465 pi/64, ...
//   d_n = n a_n/27^(n/2),  d_(n+2)/d_n = 1 + 5/(9 n (n + 2)) > 1,  d_n -> 1
//
// (alpha + pi = 2 int_0^(1/b) (du/dw)/sqrt(1/b^2 - w^2) dw with w = u sqrt(1 - 2 m u); Lagrange's inversion
// gives u(w), and every term integrates to a Beta function). So 0 < d_n < 1: what a law leaves out from x^n
// on is less than x^n/n + x^(n+1)/(n+1) + ..., and the whole grows like -ln(1 - x) as light begins to wind
// round the mass.

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace lensplane {

enum class Law { Weak, SecondOrder, Exact };

/// An angle and its derivative by the impact parameter.
struct Deflection {
  double alpha;      // radians
  double dalpha_db;  // radians per metre, negative
};

/// b_c = 3 sqrt(3) m: light with a smaller impact parameter falls into the mass (photon sphere).
inline constexpr double kCriticalRatio = 5.196152422706631880582339;

/// The weak law, equation (4) of the paper: alpha = 4 m/b. weak_deflection(1, 100) = 0.04.
/// Short of the exact angle by 10 % at b = 30 m, 1 % at 295 m, 0.1 % at 2946 m. Infinite at b = 0 for m > 0.
constexpr double weak_deflection(double m, double b) {
  return 4.0 * m / b;
}

// Each law's angle and derivative, for m >= 0 and b >= 0, lengths between 1e-300 and 1e300. Without mass
// nothing bends: 0 and 0, even at b = 0.

/// 4 m/b; infinite, -infinite at b = 0.
Deflection weak_law(double m, double b);

/// 4 m/b + (15 pi/4) (m/b)^2; infinite, -infinite at b = 0.
/// Short of the exact angle by 10 % at b = 11 m, 1 % at 33 m, 0.1 % at 104 m.
Deflection second_order_law(double m, double b);

/// Schwarzschild's (src/exact_law.h); infinite, -infinite for b <= kCriticalRatio m.
Deflection exact_law(double m, double b);

// Bounds of |alpha - exact alpha| in radians, apart from the last bits that alpha itself is rounded to. They
// fall with b: a bound at the smallest b of a region holds in all of it. Infinite for b <= kCriticalRatio m;
// 0 without mass.
double weak_law_error(double m, double b);
double second_order_law_error(double m, double b);
double exact_law_error(double m, double b);

/// Relative error of the exact law's alpha and dalpha_db, for every b > kCriticalRatio m.
inline constexpr double kExactLawError = 1e-14;

/// How far above the true errors the bounds of the two weaker laws are at most, for b > 30 m.
inline constexpr double kLawErrorTightness = 1.05;

struct LawEntry {
  Law law;
  std::string_view name;  // in shot files
  Deflection (*deflection)(double m, double b);
  double capture_ratio;  // light with b <= capture_ratio m is captured
  double (*error_bound)(double m, double b);
};

/// By rising accuracy. The photon sphere does not depend on how the light further out is computed.
inline constexpr std::array kLaws = {
    LawEntry{Law::Weak, "weak", weak_law, kCriticalRatio, weak_law_error},
    LawEntry{Law::SecondOrder, "second-order", second_order_law, kCriticalRatio, second_order_law_error},
    LawEntry{Law::Exact, "exact", exact_law, kCriticalRatio, exact_law_error},
};

constexpr const LawEntry& entry_of(Law law) {
  return kLaws[static_cast<std::size_t>(law)];
}

constexpr std::string_view name_of(Law law) {
  return entry_of(law).name;
}

constexpr std::optional<Law> law_named(std::string_view name) {
  for (const LawEntry& entry : kLaws) {
    if (entry.name == name) return entry.law;
  }
  return std::nullopt;
}

}  // namespace lensplane
