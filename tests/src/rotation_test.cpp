// SPDX-License-Identifier: Apache-2.0

#include "src/rotation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/near_turn.h"

namespace lensplane {
namespace {

/// C, S, E and their derivatives by q = A^2, in long double.
struct Expected {
  long double cosine, sine, versine;
  long double cosine_slope, sine_slope, versine_slope;
};

Expected expected(double q) {
  const long double a = std::sqrt(static_cast<long double>(q));
  if (a < 0.05L) {  // the first terms of the series do; the quotients below lose digits
    const long double w = q;
    return {std::cos(a),
            1 - w / 6 * (1 - w / 20 * (1 - w / 42 * (1 - w / 72))),
            0.5L * (1 - w / 12 * (1 - w / 30 * (1 - w / 56 * (1 - w / 90)))),
            -0.5L * (1 - w / 6 * (1 - w / 20 * (1 - w / 42 * (1 - w / 72)))),
            -1.0L / 6 * (1 - w / 10 * (1 - w / 28 * (1 - w / 54 * (1 - w / 88)))),
            -1.0L / 24 * (1 - w / 15 * (1 - w / 37.33333333333333333333L * (1 - w / 67.5L)))};
  }
  const long double half = std::sin(a / 2);
  const long double c = std::cos(a), s = std::sin(a) / a, e = 2 * half * half / (a * a);
  return {c, s, e, -s / 2, (c - s) / (2 * a * a), (s / 2 - e) / (a * a)};
}

/// Values to `error`, slopes to `slope_error`, both as a share of at least their size at A = 0.
void expect_turn(const Turn<Dual>& ours, double q, double error, double slope_error) {
  const Expected e = expected(q);
  EXPECT_NEAR(ours.cosine.v, static_cast<double>(e.cosine), error) << q;
  EXPECT_NEAR(ours.sine.v, static_cast<double>(e.sine), error) << q;
  EXPECT_NEAR(ours.versine.v, static_cast<double>(e.versine), error / 2) << q;
  EXPECT_NEAR(ours.cosine.dx, static_cast<double>(e.cosine_slope), slope_error / 2) << q;
  EXPECT_NEAR(ours.sine.dx, static_cast<double>(e.sine_slope), slope_error / 6) << q;
  EXPECT_NEAR(ours.versine.dx, static_cast<double>(e.versine_slope), slope_error / 24) << q;
  EXPECT_EQ(ours.cosine.dy, 2 * ours.cosine.dx);
  EXPECT_EQ(ours.sine.dy, 2 * ours.sine.dx);
  EXPECT_EQ(ours.versine.dy, 2 * ours.versine.dx);
}

Dual dual_at(double q) {
  return {q, 1, 2};
}

/// The first term of sin(A)/A that short_turn() leaves out, A^8/9!, is 1e-16 at the largest short turn; its
/// slope there is this share of 1/6.
constexpr double kShortSlopeError = 1.1e-12;

TEST(Rotation, ShortTurnsAreThoseOfTheLibraryToRounding) {
  for (double a = 0; a <= kShortTurn; a += 1e-4) {
    const double q = std::min(a * a, kShortTurn * kShortTurn);
    expect_turn(short_turn(dual_at(q)), q, 2.3e-16, kShortSlopeError);
  }
}

TEST(Rotation, TurnsOfAnySizeAreThoseOfTheLibrary) {
  for (double a = 0; a < 40; a += 1.7e-3) expect_turn(turn(dual_at(a * a)), a * a, 4e-15, kShortSlopeError);
}

TEST(Rotation, NoTurnIsTheIdentityWithItsDerivatives) {
  const Turn<Dual> none = turn(dual_at(0));
  EXPECT_EQ(none.cosine.v, 1);
  EXPECT_EQ(none.sine.v, 1);
  EXPECT_EQ(none.versine.v, 0.5);
  EXPECT_EQ(none.cosine.dx, -0.5);
  EXPECT_EQ(none.sine.dx, -1.0 / 6);
  EXPECT_EQ(none.versine.dx, -1.0 / 24);
}

TEST(NearTurn, SinesAndCosinesAreThoseOfTheLibrary) {
  double worst = 0;
  for (double a = 0; a <= kLongestTurn; a += 3.1e-4) {
    const SineAndCosine ours = sine_and_cosine(a);
    worst = std::max(worst, std::abs(ours.sine - static_cast<double>(std::sin(static_cast<long double>(a)))));
    worst =
        std::max(worst, std::abs(ours.cosine - static_cast<double>(std::cos(static_cast<long double>(a)))));
  }
  EXPECT_LE(worst, kNearTurnError);
}

TEST(NearTurn, QuarterTurnsChangeNoSign) {
  for (int quarter = 0; quarter < 60; ++quarter) {
    for (const double beside : {-1e-9, 0.0, 1e-9}) {
      const double a = quarter * 1.5707963267948966 + beside;
      if (a < 0) continue;
      const SineAndCosine ours = sine_and_cosine(a);
      EXPECT_NEAR(ours.sine, std::sin(a), kNearTurnError) << a;
      EXPECT_NEAR(ours.cosine, std::cos(a), kNearTurnError) << a;
    }
  }
}

TEST(NearTurn, IsTheRotationOfTheReference) {
  for (double a = 0; a < kLongestTurn; a += 1.3e-3) {
    // A itself is rounded: that costs what A has digits before the point.
    expect_turn(near_turn(dual_at(a * a)), a * a, 2 * kNearTurnError + 2e-16 * a, kNearSlopeError);
  }
}

TEST(NearTurn, DoesNotCareOnWhichSideOfTheShortTurnsItIs) {
  const double edge = kShortTurn * kShortTurn;
  const Turn<Dual> below = near_turn(dual_at(edge)), above = near_turn(dual_at(edge * (1 + 1e-15)));
  EXPECT_NEAR(below.cosine.v, above.cosine.v, kNearTurnError);
  EXPECT_NEAR(below.sine.v, above.sine.v, kNearTurnError);
  EXPECT_NEAR(below.versine.v, above.versine.v, kNearTurnError);
  EXPECT_NEAR(below.sine.dx, above.sine.dx, kNearSlopeError / 6);
  EXPECT_NEAR(below.versine.dx, above.versine.dx, kNearSlopeError / 24);
}

}  // namespace
}  // namespace lensplane
