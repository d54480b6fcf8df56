// SPDX-License-Identifier: Apache-2.0
//
// References for the exact deflection angle that share nothing with src/exact_law.h: the series, whose
// coefficients are known in closed form, and Darwin's formula with Boost's elliptic integrals.

#pragma once

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <random>

#include "src/deflection.h"

namespace lensplane {

using Big = boost::multiprecision::cpp_bin_float_50;

struct Sum {
  long double alpha;
  long double dalpha_dx;
};

/// The series of src/deflection.h from x^first on, x <= 0.9. All its terms are positive: nothing cancels.
inline Sum series(long double x, int first = 1) {
  long double d[] = {4.0L / std::sqrt(27.0L), 5.0L * std::acos(-1.0L) / 18.0L};  // d_1 and d_2
  Sum sum{0.0L, 0.0L};
  long double power = 1.0L;  // x^(n-1)
  for (int n = 1; n < 600; ++n) {
    long double& d_n = d[(n - 1) % 2];
    if (n >= first) {
      sum.alpha += d_n / n * power * x;
      sum.dalpha_dx += d_n * power;
    }
    d_n *= 1.0L + 5.0L / (9.0L * n * (n + 2.0L));
    power *= x;
  }
  return sum;
}

/// Darwin's formula for m = 1. Takes u = 1 - b_c/b as well, from which the closest approach follows with all
/// its digits next to the photon sphere. Far from the mass most of 4 sqrt(P/Q) (K - F) is the pi that is
/// taken off: for u > 0.1 the series is better.
template <class Real>
Real darwin(const Real& b, const Real& u) {
  using std::asin, std::cos, std::sqrt;
  const Real pi = boost::math::constants::pi<Real>();
  const Real p = 2 * b / sqrt(Real(3)) * cos((pi - 2 * asin(sqrt(u / 2))) / 3);
  const Real q = sqrt((p - 2) * (p + 6));
  const Real k = sqrt((q - p + 6) / (2 * q));
  const Real z = asin(sqrt((q - p + 2) / (q - p + 6)));
  return 4 * sqrt(p / q) * (boost::math::ellint_1(k) - boost::math::ellint_1(k, z)) - pi;
}

/// The exact angle for mass m in 50 digits.
inline Big darwin_50(const Big& m, const Big& b) {
  const Big b_c = 3 * sqrt(Big(3)) * m;
  return darwin<Big>(b / m, (b - b_c) / b);
}

/// The exact angle for m = 1 to 17 digits or more.
inline long double exact_reference(double b) {
  const long double x = std::sqrt(27.0L) / b;
  if (x < 0.9L) return series(x).alpha;
  // b - kCriticalRatio is exact; the second difference is 3 sqrt(3) - kCriticalRatio.
  const long double gap = static_cast<long double>(b) - kCriticalRatio;
  return darwin<long double>(b, (gap + 1.4303668319585554e-16L) / b);
}

/// Impact parameters for m = 1, log-uniform in b/b_c - 1 between `low` and `high`.
class ImpactParameters {
 public:
  ImpactParameters(double low, double high) : exponent_(std::log(low), std::log(high)) {}
  double next() { return kCriticalRatio * (1.0 + std::exp(exponent_(generator_))); }

 private:
  std::mt19937_64 generator_{1};
  std::uniform_real_distribution<double> exponent_;
};

inline double relative_error(double value, long double reference) {
  return static_cast<double>(std::abs(value / reference - 1.0L));
}

}  // namespace lensplane
