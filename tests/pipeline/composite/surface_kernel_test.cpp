// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/surface_kernel.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lensplane {
namespace {

// Of entries of the table against an integral of many steps: floats, and no more.
constexpr double kEntryError = 2e-6;

// Of lookups between the entries: the cubic's curvature within 1/64 texel.
constexpr double kBetweenEntries = 2e-4;

// Of Gaussians between two steps of the table.
constexpr double kBetweenSigmas = 2.5e-3;

// What is cut off beyond the reach, of the sum of all weights.
constexpr double kCutOff = 6e-3;

/// Catmull and Rom's cubic, by hand.
double cubic_at(double x) {
  const double r = std::abs(x);
  if (r >= 2) return 0;
  return r >= 1 ? 2 - r * (4 - r * (2.5 - 0.5 * r)) : 1 - r * r * (2.5 - 1.5 * r);
}

/// The cubic convolved with a Gaussian at a distance, summed up over its nine standard deviations.
double convolved(double distance, double sigma) {
  if (sigma == 0) return cubic_at(distance);
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double z = 9 * ((i + 0.5) / kSteps - 0.5) * 2;
    sum += cubic_at(distance - sigma * z) * std::exp(-z * z / 2);
  }
  return sum * 18 / kSteps / std::sqrt(2 * std::numbers::pi);
}

TEST(SurfaceKernel, IsTheCubicConvolvedWithGaussiansOnBothSides) {
  for (const int step : {0, 1, 13, 64, 128, 180}) {
    const double sigma = step / 256.0;
    const SurfaceKernel kernel(sigma * sigma);
    EXPECT_NEAR(kernel.reach(), std::min(3.0, 2 + 2.6 * sigma), 1e-12);
    for (int i = 0; i <= 256; i += 5) {
      const double distance = i / 64.0;
      const auto d = static_cast<float>(distance);
      EXPECT_NEAR(kernel(d), distance < kernel.reach() ? convolved(distance, sigma) : 0, kEntryError)
          << sigma << " " << d;
      EXPECT_EQ(kernel(-d), kernel(d));
    }
    EXPECT_EQ(kernel(1e6F), 0);
    // Between the entries.
    for (double distance = 0; distance < kernel.reach() - 0.1; distance += 0.0371) {
      EXPECT_NEAR(kernel(static_cast<float>(distance)), convolved(distance, sigma), kBetweenEntries);
    }
  }
  for (const double sigma : {0.0021, 0.123, 0.4567, 0.6}) {
    const SurfaceKernel kernel(sigma * sigma);
    for (double distance = 0; distance < 2; distance += 0.0371) {
      EXPECT_NEAR(kernel(static_cast<float>(distance)), convolved(distance, sigma), kBetweenSigmas) << sigma;
    }
  }
}

TEST(SurfaceKernel, NoWeightIsNegativeUnderWideGaussians) {
  const SurfaceKernel narrow(0.1), wide(1);
  EXPECT_LT(narrow(1.5F), -0.02F);
  for (float distance = 0; distance < 4; distance += 0.05F) EXPECT_GE(wide(distance), 0);
}

TEST(SurfaceKernel, UnderNoGaussianATexelIsItself) {
  const SurfaceKernel kernel(0);
  const Taps at_texel = kernel.taps(0), at_next = kernel.taps(1);
  for (int n = 0; n < Taps::kCount; ++n) {
    EXPECT_EQ(at_texel.weight[n], n == -SurfaceKernel::kFirstTap ? 1.0F : 0.0F);
    EXPECT_EQ(at_next.weight[n], n == 1 - SurfaceKernel::kFirstTap ? 1.0F : 0.0F);
  }
}

TEST(SurfaceKernel, TapsAreTheWeightsOfTexelsSideBySide) {
  for (const double sigma : {0.0, 0.05, 0.123, 0.4567, 0.9, 1.0}) {
    for (const double slant : {0.0, 0.6, 1.0}) {
      const SurfaceKernel kernel(sigma * sigma, slant);
      for (float share = 0; share <= 1; share += 0.0371F) {
        const Taps taps = kernel.taps(share);
        float sum = 0;
        for (int n = 0; n < Taps::kCount; ++n) {
          const float distance = static_cast<float>(n + SurfaceKernel::kFirstTap) - share;
          EXPECT_NEAR(taps.weight[n], kernel(distance), kCutOff) << sigma << " " << distance;
          sum += taps.weight[n];
        }
        EXPECT_NEAR(sum, 1, 1e-6);
      }
    }
  }
}

TEST(SurfaceKernel, WeighsTexelsAStepApart) {
  const SurfaceKernel kernel(0.1, 0.4);
  float weights[5] = {2, 2, 2, 2, 2};
  kernel.weigh(-1.3F, 0.7F, 5, weights);
  for (int n = 0; n < 5; ++n) EXPECT_NEAR(weights[n], 2 * kernel(-1.3F + 0.7F * static_cast<float>(n)), 1e-6);
}

TEST(SurfaceKernel, WiderGaussiansThanTheTableAreItsWidest) {
  const SurfaceKernel widest(1), wider(7);
  EXPECT_EQ(wider.reach(), widest.reach());
  for (const float distance : {0.0F, 0.7F, 2.3F}) EXPECT_EQ(wider(distance), widest(distance));
}

TEST(SurfaceKernel, HasTheGaussiansVariance) {
  // The cubic has none of its own: parabolas stay what they are.
  for (const double sigma : {0.0, 0.1, 0.3, 0.5}) {
    const SurfaceKernel kernel(sigma * sigma);
    double variance = 0, sum = 0;
    for (double x = -4; x < 4; x += 1.0 / 256) {
      variance += x * x * static_cast<double>(kernel(static_cast<float>(x))) / 256;
      sum += static_cast<double>(kernel(static_cast<float>(x))) / 256;
    }
    EXPECT_NEAR(sum, 1, 3e-3) << sigma;
    EXPECT_NEAR(variance, sigma * sigma, 0.015) << sigma;
  }
}

TEST(SurfaceKernel, SlantedRowsAreSeenThroughTheCubicTwice) {
  // On a slant of 1: the cubic convolved with itself, here by another sum.
  const SurfaceKernel kernel(0, 1);
  for (double distance = 0; distance < 2.9; distance += 0.13) {
    double sum = 0;
    for (int i = -2000; i < 2000; ++i) {
      const double x = (i + 0.5) / 1000;
      sum += cubic_at(x) * cubic_at(distance - x) / 1000;
    }
    EXPECT_NEAR(kernel(static_cast<float>(distance)), sum, 2e-3) << distance;
  }
  // In between a share of it.
  const SurfaceKernel plain(0), half(0, 0.5);
  EXPECT_NEAR(half(0.3F), plain(0.3F) + 0.125F * (kernel(0.3F) - plain(0.3F)), 1e-5);
}

}  // namespace
}  // namespace lensplane
