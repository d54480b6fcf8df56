// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/keyed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lensplane {
namespace {

TEST(Keyed, ConstantIsTheSameAtAllFrames) {
  const auto constant = Keyed<double>::constant(7);
  EXPECT_EQ(value_at(constant, -1e9), 7);
  EXPECT_EQ(value_at(constant, 0), 7);
  EXPECT_EQ(value_at(constant, 1e9), 7);
  EXPECT_EQ(value_at(Keyed<Vec3>{}, 5), Vec3(0));
}

TEST(Keyed, LinearGoesStraightAndHoldsTheEnds) {
  const Keyed<double> keyed{{1001, 1011, 1021}, {0, 10, -10}, Interpolation::Linear};
  EXPECT_DOUBLE_EQ(value_at(keyed, 1006), 5);
  EXPECT_DOUBLE_EQ(value_at(keyed, 1006.25), 5.25);
  EXPECT_DOUBLE_EQ(value_at(keyed, 1016), 0);
  EXPECT_EQ(value_at(keyed, 900), 0);
  EXPECT_EQ(value_at(keyed, 2000), -10);
}

TEST(Keyed, StepHoldsUntilTheNextKey) {
  const Keyed<double> keyed{{1, 2, 3}, {10, 20, 30}, Interpolation::Step};
  EXPECT_EQ(value_at(keyed, 1.999), 10);
  EXPECT_EQ(value_at(keyed, 2), 20);
  EXPECT_EQ(value_at(keyed, 2.5), 20);
  EXPECT_EQ(value_at(keyed, 3), 30);
}

TEST(Keyed, SmoothMeetsEveryKeyAndNeverOvershoots) {
  const Keyed<double> keyed{{0, 1, 2, 5, 6}, {0, 0, 1, 1.1, -3}, Interpolation::Smooth};
  for (std::size_t k = 0; k < keyed.frames.size(); ++k)
    EXPECT_EQ(value_at(keyed, keyed.frames[k]), keyed.values[k]);
  for (std::size_t k = 0; k + 1 < keyed.frames.size(); ++k) {
    const double low = std::min(keyed.values[k], keyed.values[k + 1]);
    const double high = std::max(keyed.values[k], keyed.values[k + 1]);
    double before = keyed.values[k];
    for (double u = 0; u <= 1; u += 1e-3) {
      const double value = value_at(keyed, keyed.frames[k] + u * (keyed.frames[k + 1] - keyed.frames[k]));
      EXPECT_GE(value, low - 1e-14);
      EXPECT_LE(value, high + 1e-14);
      if (keyed.values[k + 1] > keyed.values[k]) {
        EXPECT_GE(value, before - 1e-14);
      }
      before = value;
    }
  }
}

TEST(Keyed, SmoothHasNoCorners) {
  const Keyed<double> keyed{{0, 1, 3, 4}, {0, 2, 3, 7}, Interpolation::Smooth};
  const double h = 1e-6;
  for (const double key : {1.0, 3.0}) {
    const double left = (value_at(keyed, key) - value_at(keyed, key - h)) / h;
    const double right = (value_at(keyed, key + h) - value_at(keyed, key)) / h;
    EXPECT_NEAR(left, right, 1e-4);
    EXPECT_GT(left, 0.1);
  }
}

TEST(Keyed, SmoothReproducesAParabolaToTheOrderOfTheMethod) {
  // Harmonic-mean slopes are of second order on equal steps: the error falls by at least four when steps are
  // halved.
  const auto error_with = [](int steps) {
    Keyed<double> keyed{{}, {}, Interpolation::Smooth};
    keyed.frames.clear();
    keyed.values.clear();
    for (int i = 0; i <= steps; ++i) {
      const double x = 1 + 1.0 * i / steps;
      keyed.frames.push_back(x);
      keyed.values.push_back(x * x);
    }
    double worst = 0;
    for (double x = 1.3; x < 1.7; x += 0.001) worst = std::max(worst, std::abs(value_at(keyed, x) - x * x));
    return worst;
  };
  EXPECT_LT(error_with(20), error_with(10) / 4);
  EXPECT_LT(error_with(10), 1e-3);
}

TEST(Keyed, VectorsAreInterpolatedByComponent) {
  const Keyed<Vec3> keyed{{0, 10}, {{0, 5, -1}, {10, 5, 1}}, Interpolation::Linear};
  EXPECT_EQ(value_at(keyed, 5), Vec3(5, 5, 0));
}

}  // namespace
}  // namespace lensplane
