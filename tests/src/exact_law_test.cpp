// SPDX-License-Identifier: Apache-2.0

#include "src/exact_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/src/exact_angle.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kSamples = 100000;

struct Published {
  long double b;  // of m
  long double alpha;
};

/// b is written in decimals and steep is the angle near b_c: what b loses in becoming a double is made good.
void expect_published(const Published& published) {
  const auto b = static_cast<double>(published.b);
  const Deflection exact = exact_law(1.0, b);
  const long double alpha = exact.alpha + exact.dalpha_db * (published.b - b);
  EXPECT_LT(std::abs(alpha / published.alpha - 1.0L), kExactLawError) << "b = " << b;
}

TEST(ExactLaw, HasThePublishedAngles) {
  constexpr Published kTable[] = {
      {5.19616L, 13.03805008693978029L}, {5.1963L, 10.06896361837861959L}, {5.197L, 8.321408085687579182L},
      {5.2L, 6.810371956663496872L},     {5.21L, 5.534916981253387650L},   {5.25L, 4.194799708234656276L},
      {5.3L, 3.557938042459651486L},     {5.5L, 2.553020182345338313L},    {6.0L, 1.719388310230168613L},
      {7.0L, 1.127639104731336301L},     {8.0L, 0.8587300180790952602L},   {10.0L, 0.5903957876058273212L},
      {12.0L, 0.4526054125988864328L},   {15.0L, 0.3363657260294845936L},  {20.0L, 0.2361359953884699044L},
      {30.0L, 0.1482480872727554238L},   {50.0L, 0.08508345038324747283L}, {100.0L, 0.04122253974927365171L},
      {1e3L, 0.004011823809925364710L},  {1e4L, 4.00117852408192234e-4L},  {1e6L, 4.00001178101511779848e-6L},
      {1e8L, 4.000000117809728776e-8L},
  };
  for (const Published& published : kTable) expect_published(published);
}

TEST(ExactLaw, TurnsLightByWholeAngles) {
  const long double pi = std::acos(-1.0L);
  expect_published({6.16756676476800632L, pi / 2.0L});
  expect_published({5.35695863074178869L, pi});
  expect_published({5.20268040281045576L, 2.0L * pi});
  expect_published({5.19643350110572471L, 3.0L * pi});
}

TEST(ExactLaw, IsDarwinsAngle) {
  ImpactParameters parameters(1e-6, 1e8);
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double b = parameters.next();
    worst = std::max(worst, relative_error(exact_law(1.0, b).alpha, exact_reference(b)));
  }
  EXPECT_LT(worst, kExactLawError);
}

TEST(ExactLaw, DerivativeIsThatOfTheSeries) {
  ImpactParameters parameters(0.12, 1e8);
  double worst = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    const double b = parameters.next();
    const long double x = std::sqrt(27.0L) / b;
    worst = std::max(worst, relative_error(exact_law(1.0, b).dalpha_db, -x / b * series(x).dalpha_dx));
  }
  EXPECT_LT(worst, kExactLawError);
}

TEST(ExactLaw, HoldsDownToTheLastBitBeforeThePhotonSphere) {
  ImpactParameters parameters(2e-16, 0.12);
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> log_mass(-10.0, 30.0);
  for (int i = 0; i < 300; ++i) {
    const double m = i % 2 == 0 ? 1.0 : std::exp(log_mass(generator));
    const double next = std::nextafter(kCriticalRatio * m, kInfinity);
    const double b = i < 20 ? next : std::max(next, m * parameters.next());
    const Deflection exact = exact_law(m, b);
    const Big h = (b - 3 * sqrt(Big(3)) * m) * Big("1e-12");
    const Big slope = (darwin_50(m, b + h) - darwin_50(m, b - h)) / (2 * h);
    EXPECT_LT(std::abs(static_cast<double>(exact.alpha / darwin_50(m, b) - 1)), kExactLawError)
        << m << ' ' << b;
    EXPECT_LT(std::abs(static_cast<double>(exact.dalpha_db / slope - 1)), kExactLawError) << m << ' ' << b;
  }
}

TEST(ExactLaw, IsInfiniteFromThePhotonSphereInwards) {
  for (double m : {1.0, 0.3, 1477.0, 1e30}) {
    const double b_c = kCriticalRatio * m;
    EXPECT_TRUE(std::isfinite(exact_law(m, std::nextafter(b_c, kInfinity)).alpha));
    for (double b : {b_c, std::nextafter(b_c, 0.0), m, 0.0}) {
      EXPECT_EQ(exact_law(m, b).alpha, kInfinity);
      EXPECT_EQ(exact_law(m, b).dalpha_db, -kInfinity);
    }
  }
}

TEST(ExactLaw, GrowsLogarithmicallyTowardsThePhotonSphere) {
  for (double share : {1e-6, 1e-8, 1e-10}) {
    const double b = kCriticalRatio * (1.0 + share);
    const long double true_share = b / std::sqrt(27.0L) - 1.0L;
    const double limit = static_cast<double>(-std::log(true_share) - 0.400230039755261653275L);
    // The next term is smaller than the share times its logarithm.
    EXPECT_NEAR(exact_law(1.0, b).alpha, limit, -share * std::log(share)) << share;
  }
}

TEST(FarExactRatio, IsTheExactLawFarAway) {
  EXPECT_DOUBLE_EQ(far_exact_ratio(0.0), 4.0 / kCriticalRatio);
  for (int i = 1; i <= 10000; ++i) {
    const double x = kFarRatio * i / 10000.0;
    const Sum reference = series(x);
    const Dual by_x(x, 1.0, -2.0);
    const Dual alpha = by_x * far_exact_ratio(by_x);
    EXPECT_EQ(alpha.v, x * far_exact_ratio(x));
    ASSERT_LT(relative_error(alpha.v, reference.alpha), kFarError) << x;
    ASSERT_LT(relative_error(alpha.dx, reference.dalpha_dx), kFarSlopeError) << x;
    EXPECT_EQ(alpha.dy, -2.0 * alpha.dx);
  }
}

TEST(LogOfShare, IsTheLibrarysLogarithm) {
  for (int i = 0; i < kSamples; ++i) {
    const double small = std::pow(10.0, -16.0 * (i + 0.5) / kSamples);
    const double large = 1.0 - small;
    ASSERT_LT(relative_error(log_of_share(large, small), std::log(static_cast<long double>(small))),
              kLogError)
        << i;
    ASSERT_LT(relative_error(log_of_share(small, large), std::log1p(-static_cast<long double>(small))),
              kLogError)
        << i;
  }
  EXPECT_EQ(log_of_share(0.0, 1.0), 0.0);
}

TEST(LogOfShare, HoldsBeyondOne) {
  // As the Shapiro delay takes it: of a ratio of lengths, given as 1 - ratio and ratio.
  for (int i = 0; i < kSamples; ++i) {
    const double ratio = std::pow(10.0, 300.0 * (i + 0.5) / kSamples);
    ASSERT_LT(relative_error(log_of_share(1.0 - ratio, ratio), std::log(static_cast<long double>(ratio))),
              kLogError)
        << ratio;
    const double near = 1.0 + std::pow(10.0, -15.0 * (i + 0.5) / kSamples);
    ASSERT_LT(relative_error(log_of_share(1.0 - near, near), std::log(static_cast<long double>(near))),
              kLogError)
        << near;
  }
}

}  // namespace
}  // namespace lensplane
