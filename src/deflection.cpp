// SPDX-License-Identifier: Apache-2.0

#include "src/deflection.h"

#include <limits>

#include "src/constants.h"
#include "src/exact_law.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSecondOrder = 15.0 * kPi / 4.0;

/// What a law leaves out of the series (head of deflection.h) from its n-th term `term` x^n on is less than
/// x^n (term + x/(n + 1) + x^2/2 + x^3/3 + ...), where x^j/j stands for x^j/(n + j) from j = 2 on.
double remainder_bound(int n, double term, double m, double b) {
  if (m == 0.0) return 0.0;
  if (b <= kCriticalRatio * m) return kInfinity;
  const auto [x, u] = shares_of(m, b);
  double x_to_n = 1.0;
  for (int i = 0; i < n; ++i) x_to_n *= x;
  return x_to_n * (term - log_of_share(x, u) - x * n / (n + 1.0));
}

}  // namespace

Deflection weak_law(double m, double b) {
  if (m == 0.0) return {0.0, 0.0};
  const double alpha = weak_deflection(m, b);
  return {alpha, -alpha / b};
}

Deflection second_order_law(double m, double b) {
  if (m == 0.0) return {0.0, 0.0};
  const double first = weak_deflection(m, b);
  const double second = kSecondOrder * (m / b) * (m / b);
  return {first + second, -(first + 2.0 * second) / b};
}

Deflection exact_law(double m, double b) {
  if (m == 0.0) return {0.0, 0.0};
  if (b <= kCriticalRatio * m) return {kInfinity, -kInfinity};
  return near_exact(m, b);
}

double weak_law_error(double m, double b) {
  return remainder_bound(2, 0.4364, m, b);  // a_2/27 = 0.43633..., rounded up
}

double second_order_law_error(double m, double b) {
  return remainder_bound(3, 0.3042, m, b);  // a_3/27^(3/2) = 0.30412..., rounded up
}

double exact_law_error(double m, double b) {
  return kExactLawError * exact_law(m, b).alpha;
}

}  // namespace lensplane
