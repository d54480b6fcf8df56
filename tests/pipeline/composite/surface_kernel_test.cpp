// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/surface_kernel.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lensplane {
namespace {

// Of entries of the table against an integral of many steps: floats, and no more.
constexpr double kEntryError = 2e-6;

// Of lookups between the entries, for Gaussians of a twentieth of a texel and more.
constexpr double kBetweenEntries = 3e-3;

// What is cut off beyond kReach, of the sum of all weights.
constexpr double kCutOff = 2.5e-3;

// Two points for a Gaussian: of |x|^3/2, where the spline's third derivative jumps by 6, they see s^3/2 and
// the Gaussian sqrt(2/pi) s^3.
constexpr double kTwoPoints = 0.3;

double triangle_at(double x) {
  return std::max(0.0, 1 - std::abs(x));
}

double spline_at(double x) {
  const double r = std::abs(x);
  if (r >= 2) return 0;
  return r >= 1 ? std::pow(2 - r, 3) / 6 : (4 - 6 * r * r + 3 * r * r * r) / 6;
}

/// `shape` convolved with a Gaussian at a distance, summed up over its nine standard deviations.
double convolved(double (*shape)(double), double distance, double sigma) {
  if (sigma == 0) return shape(distance);
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double z = 9 * ((i + 0.5) / kSteps - 0.5) * 2;
    sum += shape(distance - sigma * z) * std::exp(-z * z / 2);
  }
  return sum * 18 / kSteps / std::sqrt(2 * std::numbers::pi);
}

bool is_within(double distance, double sigma) {
  return distance <= 1 + TapTable::kReach * sigma;
}

TEST(SurfaceKernel, TableHoldsTheTriangleConvolvedWithGaussians) {
  const TapTable& table = TapTable::get();
  for (const int step : {0, 1, 13, 64, 128, 200, 256}) {
    const double sigma = step / 256.0;
    for (int place = 0; place <= TapTable::kPlaces; place += 5) {
      for (int n = 0; n < Taps::kCount; ++n) {
        const double distance = std::abs(n + SurfaceKernel::kFirstTap - place / 64.0);
        const float weight = table.row(sigma)[place].weight[n];
        if (distance > 1 + TapTable::kReach * sigma + 1.5 / TapTable::kPlaces) {
          EXPECT_EQ(weight, 0) << sigma << " " << distance;
        } else if (is_within(distance, sigma)) {
          EXPECT_NEAR(weight, convolved(triangle_at, distance, sigma), kEntryError)
              << sigma << " " << distance;
        }
      }
    }
  }
  // By hand: the triangle itself, and E max(0, 1 - |z|) for sigma 1 = erf(1/sqrt(2)) - 2 (phi(0) - phi(1)).
  EXPECT_EQ(table.row(0)[32].weight[3], 0.5F);
  EXPECT_NEAR(table.row(1)[0].weight[3], 0.682689492137086 - 2 * (0.398942280401433 - 0.241970724519143),
              1e-6);
}

TEST(SurfaceKernel, RoundsKinksAsAGaussianDoes) {
  for (double z = 0; z < 5; z += 0.0173) {
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
    EXPECT_NEAR(rounded_kink(static_cast<float>(z)), density - z * std::erfc(z / std::numbers::sqrt2) / 2,
                kKinkError)
        << z;
  }
}

TEST(SurfaceKernel, IsTheTriangleConvolvedWithGaussiansOnBothSides) {
  for (const double sigma : {0.0, 0.05, 0.123, 0.2999, 0.3001, 0.4567, 0.9, 1.0}) {
    const SurfaceKernel kernel(sigma * sigma, 0);
    EXPECT_NEAR(kernel.reach(), 1 + 2.6 * sigma, 1e-12);
    for (double distance = 0; distance < 5; distance += 0.0371) {
      const auto d = static_cast<float>(distance);
      EXPECT_NEAR(kernel(d), convolved(triangle_at, distance, sigma), 4 * kKinkError * sigma + 1e-6)
          << sigma << " " << d;
      EXPECT_EQ(kernel(-d), kernel(d));
      float weighed = 2;
      kernel.weigh(d, 1, 1, &weighed);
      EXPECT_NEAR(weighed, 2 * kernel(d), 1e-6) << sigma << " " << d;
    }
    EXPECT_EQ(kernel(1e6F), 0);
  }
}

TEST(SurfaceKernel, TapsAreTheWeightsOfTexelsSideBySide) {
  for (const double sigma : {0.05, 0.123, 0.4567, 0.9, 1.0}) {
    for (const double smoothness : {0.0, 0.4, 1.0}) {
      const SurfaceKernel kernel(sigma * sigma, smoothness);
      for (float share = 0; share <= 1; share += 0.0371F) {
        const Taps taps = kernel.taps(share);
        for (int n = 0; n < Taps::kCount; ++n) {
          const float distance = static_cast<float>(n + SurfaceKernel::kFirstTap) - share;
          if (!is_within(std::abs(distance), sigma)) continue;
          EXPECT_NEAR(taps.weight[n], kernel(distance), kBetweenEntries) << sigma << " " << distance;
        }
      }
    }
  }
}

TEST(SurfaceKernel, WiderGaussiansThanTheTableAreItsWidest) {
  const SurfaceKernel widest(1, 0), wider(7, 0);
  EXPECT_EQ(wider.reach(), widest.reach());
  for (const float distance : {0.0F, 0.7F, 2.3F}) EXPECT_EQ(wider(distance), widest(distance));
}

TEST(SurfaceKernel, SumsToOneOverAllTexels) {
  for (const double sigma : {0.0, 0.05, 0.3, 0.7, 1.0}) {
    for (const double smoothness : {0.0, 0.4, 1.0}) {
      const SurfaceKernel kernel(sigma * sigma, smoothness);
      for (double offset = 0; offset < 1; offset += 0.0173) {
        double sum = 0;
        for (int texel = -8; texel <= 8; ++texel) sum += kernel(static_cast<float>(texel - offset));
        EXPECT_NEAR(sum, 1, sigma == 0 ? 1e-6 : kCutOff) << sigma << " " << smoothness << " " << offset;
      }
    }
  }
}

TEST(SurfaceKernel, SplineHasTheGaussiansVariance) {
  // The variances of the spline and of the two points add up exactly.
  for (const double sigma : {0.0, 0.1, 0.5}) {
    const SurfaceKernel kernel(sigma * sigma, 1);
    EXPECT_NEAR(kernel.reach(), std::max(2 + sigma, 1 + 2.6 * sigma), 1e-12);
    double variance = 0;
    for (double x = -4; x < 4; x += 1.0 / 256) variance += x * x * kernel(static_cast<float>(x)) / 256;
    EXPECT_NEAR(variance, 1.0 / 3 + sigma * sigma, 1e-5) << sigma;
    for (double x = 0; x < 2; x += 0.117) {
      EXPECT_NEAR(kernel(static_cast<float>(x)), convolved(spline_at, x, sigma),
                  kTwoPoints * std::pow(sigma, 3) + 1e-6);
    }
  }
  // Half way between the two surfaces the weights are.
  const SurfaceKernel triangle(0.01, 0), spline(0.01, 1), half(0.01, 0.5);
  for (const float x : {0.0F, 0.3F, 1.1F}) EXPECT_NEAR(half(x), (triangle(x) + spline(x)) / 2, 1e-6F);
}

}  // namespace
}  // namespace lensplane
