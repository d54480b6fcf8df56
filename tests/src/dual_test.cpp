// SPDX-License-Identifier: Apache-2.0

#include "src/dual.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lensplane {
namespace {

/// `f` of two Dual numbers a and b, whose derivatives are da/dx = 1, da/dy = 0, db/dx = 0, db/dy = 1, against
/// its value `value` and its derivatives by a and b.
template <class F>
void expect_rule(F f, double a, double b, double value, double by_a, double by_b) {
  const Dual ours = f(Dual(a, 1, 0), Dual(b, 0, 1));
  EXPECT_DOUBLE_EQ(ours.v, value);
  EXPECT_DOUBLE_EQ(ours.dx, by_a);
  EXPECT_DOUBLE_EQ(ours.dy, by_b);
  // Both derivatives by both: the chain rule.
  const Dual mixed = f(Dual(a, 3, -2), Dual(b, 0.5, 7));
  EXPECT_NEAR(mixed.dx, 3 * by_a + 0.5 * by_b, 1e-14 * (std::abs(by_a) + std::abs(by_b)) * 8);
  EXPECT_NEAR(mixed.dy, -2 * by_a + 7 * by_b, 1e-14 * (std::abs(by_a) + std::abs(by_b)) * 8);
}

TEST(Dual, OperatorsFollowTheRulesOfTheCalculus) {
  for (const double a : {0.7, -2.5, 1e8}) {
    for (const double b : {0.3, -4.0}) {
      using D = const Dual&;
      expect_rule([](D x, D y) { return x + y; }, a, b, a + b, 1, 1);
      expect_rule([](D x, D y) { return x - y; }, a, b, a - b, 1, -1);
      expect_rule([](D x, D y) { return x * y; }, a, b, a * b, b, a);
      expect_rule([](D x, D y) { return x / y; }, a, b, a / b, 1 / b, -a / (b * b));
      expect_rule([](D x, D) { return -x; }, a, b, -a, -1, 0);
      expect_rule([](D x, D) { return reciprocal(x); }, a, b, 1 / a, -1 / (a * a), 0);
      expect_rule([](D x, D) { return 3.0 + x; }, a, b, 3 + a, 1, 0);
      expect_rule([](D x, D) { return 3.0 - x; }, a, b, 3 - a, -1, 0);
      expect_rule([](D x, D) { return 3.0 * x; }, a, b, 3 * a, 3, 0);
      expect_rule([](D x, D) { return x * 3.0; }, a, b, 3 * a, 3, 0);
      expect_rule([](D x, D) { return x / 3.0; }, a, b, a / 3, 1.0 / 3, 0);
      expect_rule([](D x, D) { return 3.0 / x; }, a, b, 3 / a, -3 / (a * a), 0);
      expect_rule(
          [](D x, D) {
            Dual s = 1.0;
            return s += x;
          },
          a, b, 1 + a, 1, 0);
      expect_rule(
          [](D x, D) {
            Dual s = 1.0;
            return s -= x;
          },
          a, b, 1 - a, -1, 0);
    }
  }
}

TEST(Dual, FunctionsFollowTheRulesOfTheCalculus) {
  for (const double a : {0.7, 2.5, 30.0}) {
    for (const double b : {0.3, -4.0}) {
      using D = const Dual&;
      const double r2 = a * a + b * b;
      expect_rule([](D x, D) { return sqrt(x); }, a, b, std::sqrt(a), 0.5 / std::sqrt(a), 0);
      expect_rule([](D x, D) { return sin(x); }, a, b, std::sin(a), std::cos(a), 0);
      expect_rule([](D x, D) { return cos(x); }, a, b, std::cos(a), -std::sin(a), 0);
      expect_rule([](D x, D) { return log(x); }, a, b, std::log(a), 1 / a, 0);
      expect_rule([](D y, D x) { return atan2(y, x); }, a, b, std::atan2(a, b), b / r2, -a / r2);
      expect_rule([](D x, D y) { return length(DualVec3(x, y, 0.0)); }, a, b, std::hypot(a, b),
                  a / std::hypot(a, b), b / std::hypot(a, b));
      expect_rule([](D x, D) { return chained(x, 11.0, 13.0); }, a, b, 11, 13, 0);
    }
  }
}

TEST(Dual, LengthsNeitherOverflowNorLoseTheirDerivativesAtZero) {
  for (const double scale : {1e-300, 1e300}) {
    const Dual l = length(DualVec3(Dual(3 * scale, 1, 0), Dual(4 * scale, 0, 1), 0.0));
    EXPECT_DOUBLE_EQ(l.v, 5 * scale);
    EXPECT_DOUBLE_EQ(l.dx, 0.6);
    EXPECT_DOUBLE_EQ(l.dy, 0.8);
  }
  const Dual none = length(DualVec3(Dual(0, 1, 2), 0.0, 0.0));
  EXPECT_EQ(none.v, 0);
  EXPECT_EQ(none.dx, 0);
  EXPECT_EQ(none.dy, 0);
}

TEST(Dual, SelectsWholeNumbers) {
  const Dual a(1, 2, 3), b(4, 5, 6);
  const Dual first = select(true, a, b), second = select(false, a, b);
  EXPECT_EQ(first.v + first.dx + first.dy, 6);
  EXPECT_EQ(second.v + second.dx + second.dy, 15);
}

TEST(Dual, VectorsKeepTheirDerivatives) {
  const DualVec3 v = dual_vector({1, 2, 3}, {4, 5, 6}, {7, 8, 9});
  EXPECT_EQ(value_of(v), Imath::V3d(1, 2, 3));
  EXPECT_EQ(derivative_by_x(v), Imath::V3d(4, 5, 6));
  EXPECT_EQ(derivative_by_y(v), Imath::V3d(7, 8, 9));
  const Dual square = v.dot(v);
  EXPECT_EQ(square.v, 14);
  EXPECT_EQ(square.dx, 2 * (1 * 4 + 2 * 5 + 3 * 6));
  EXPECT_EQ(square.dy, 2 * (1 * 7 + 2 * 8 + 3 * 9));
}

}  // namespace
}  // namespace lensplane
