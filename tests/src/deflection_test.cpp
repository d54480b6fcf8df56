// SPDX-License-Identifier: Apache-2.0

#include "src/deflection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/src/exact_angle.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kSamples = 100000;

TEST(Laws, DependOnTheRatioOfMassToImpactParameterOnly) {
  for (const LawEntry& law : kLaws) {
    for (double b : {5.2, 6.0, 30.0, 1e5}) {
      const Deflection one = law.deflection(1.0, b);
      for (double k : {0x1p-900, 0x1p-40, 0x1p60, 0x1p900}) {
        EXPECT_EQ(law.deflection(k, k * b).alpha, one.alpha) << law.name;
        EXPECT_EQ(law.deflection(k, k * b).dalpha_db * k, one.dalpha_db) << law.name;
      }
    }
    EXPECT_NEAR(law.deflection(1477.0, 1477.0 * 7.0).alpha / law.deflection(1.0, 7.0).alpha, 1.0,
                kExactLawError);
  }
}

TEST(Laws, BendNothingWithoutMass) {
  for (const LawEntry& law : kLaws) {
    for (double b : {0.0, 1e-300, 1.0, 1e300}) {
      EXPECT_EQ(law.deflection(0.0, b).alpha, 0.0) << law.name;
      EXPECT_EQ(law.deflection(0.0, b).dalpha_db, 0.0) << law.name;
      EXPECT_EQ(law.error_bound(0.0, b), 0.0) << law.name;
    }
  }
}

TEST(Laws, WeakerOnesAreTheFirstTermsOfTheSeries) {
  ImpactParameters parameters(0.12, 1e8);
  for (int i = 0; i < 1000; ++i) {
    const double b = parameters.next();
    const long double x = std::sqrt(27.0L) / b;
    const Sum all = series(x), second = series(x, 2), third = series(x, 3);
    const Deflection weak = weak_law(1.0, b), second_order = second_order_law(1.0, b);
    EXPECT_LT(relative_error(weak.alpha, all.alpha - second.alpha), 1e-15);
    EXPECT_LT(relative_error(weak.dalpha_db, -x / b * (all.dalpha_dx - second.dalpha_dx)), 1e-15);
    EXPECT_LT(relative_error(second_order.alpha, all.alpha - third.alpha), 1e-15);
    EXPECT_LT(relative_error(second_order.dalpha_db, -x / b * (all.dalpha_dx - third.dalpha_dx)), 1e-15);
  }
}

/// The weak (first = 2) and the second-order law's (first = 3) true error for m = 1.
long double true_error(const LawEntry& law, int first, double b) {
  const long double x = std::sqrt(27.0L) / b;
  return x < 0.9L ? series(x, first).alpha : exact_reference(b) - law.deflection(1.0, b).alpha;
}

TEST(Laws, ErrorBoundsHoldAndAreTightFarAway) {
  ImpactParameters parameters(1e-15, 1e15);
  for (int i = 0; i < kSamples; ++i) {
    const double b = std::max(parameters.next(), std::nextafter(kCriticalRatio, kInfinity));
    for (Law law : {Law::Weak, Law::SecondOrder}) {
      const LawEntry& entry = entry_of(law);
      const long double error = true_error(entry, law == Law::Weak ? 2 : 3, b);
      const double bound = entry.error_bound(1.0, b);
      ASSERT_LE(error, bound) << entry.name << " at b = " << b;
      if (b > 30.0) {
        ASSERT_LE(bound, kLawErrorTightness * error) << entry.name << " at b = " << b;
      }
    }
  }
}

TEST(Laws, ErrorBoundsFallWithTheImpactParameter) {
  for (const LawEntry& law : kLaws) {
    EXPECT_EQ(law.error_bound(1.0, law.capture_ratio), kInfinity);
    double last = kInfinity;
    for (double share = 1e-15; share < 1e15; share *= 1.01) {
      const double bound = law.error_bound(1.0, kCriticalRatio * (1.0 + share));
      ASSERT_GT(bound, 0.0) << law.name;
      if (share > 1e-12) {  // closer by, steps of 1 % are lost in the rounding of b
        ASSERT_LT(bound, last) << law.name << " at " << share;
      }
      last = bound;
    }
  }
}

TEST(Laws, AreOffByTheirPublishedErrors) {
  const auto off = [](Law law, double b) {
    return 1.0 - entry_of(law).deflection(1.0, b).alpha / exact_law(1.0, b).alpha;
  };
  EXPECT_NEAR(off(Law::Weak, 30.18), 0.1, 1e-4);
  EXPECT_NEAR(off(Law::Weak, 295.2), 0.01, 1e-5);
  EXPECT_NEAR(off(Law::Weak, 2945.9), 0.001, 1e-7);
  EXPECT_NEAR(off(Law::SecondOrder, 10.99), 0.1, 1e-4);
  EXPECT_NEAR(off(Law::SecondOrder, 33.22), 0.01, 1e-5);
  EXPECT_NEAR(off(Law::SecondOrder, 103.8), 0.001, 1e-6);
}

TEST(Laws, AreFoundByTheirNames) {
  for (const LawEntry& law : kLaws) {
    EXPECT_EQ(entry_of(law.law).name, law.name);
    EXPECT_EQ(law_named(name_of(law.law)), law.law);
  }
  EXPECT_EQ(law_named("second-order"), Law::SecondOrder);
  EXPECT_EQ(law_named("Exact"), std::nullopt);
}

}  // namespace
}  // namespace lensplane
