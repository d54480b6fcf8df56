// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/keyed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/constants.h"

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

/// The vector in the x-y plane this many degrees from +x.
Direction at_degrees(double degrees) {
  return {{std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180), 0}};
}

double degrees_of(const Vec3& v) {
  return std::atan2(v.y, v.x) * 180 / kPi;
}

TEST(Keyed, DirectionsTurnAtAnEvenPace) {
  const Keyed<Direction> keyed{{0, 10, 30}, {at_degrees(0), at_degrees(150), at_degrees(-170)}};
  for (double frame = 0; frame <= 10; frame += 0.5) {
    const Vec3 value = value_at(keyed, frame);
    EXPECT_NEAR(degrees_of(value), 15 * frame, 1e-12);
    EXPECT_NEAR(value.length(), 1, 1e-15);
  }
  // Onwards through 180 degrees, the shorter way.
  EXPECT_NEAR(degrees_of(value_at(keyed, 20)), 170, 1e-12);
  EXPECT_EQ(value_at(keyed, 10), keyed.values[1].unit);
  EXPECT_EQ(value_at(keyed, -5), keyed.values[0].unit);
  EXPECT_EQ(value_at(keyed, 99), keyed.values[2].unit);
  const Keyed<Direction> still{{0, 10}, {at_degrees(30), at_degrees(30)}, Interpolation::Smooth};
  EXPECT_NEAR(degrees_of(value_at(still, 3)), 30, 1e-13);
}

TEST(Keyed, OppositeDirectionsTurnAboutAStatedAxis) {
  for (const auto interpolation : {Interpolation::Linear, Interpolation::Smooth}) {
    const auto halfway = [&](const Vec3& from, const Vec3& to) {
      return value_at(Keyed<Direction>{{1001, 1003}, {{from.normalized()}, {to.normalized()}}, interpolation},
                      1002);
    };
    EXPECT_LT((halfway({0, 1, 0}, {0, -1, 0}) - Vec3(0, 0, 1)).length(), 1e-15);
    EXPECT_LT((halfway({0, 0, 1}, {0, 0, -3}) - Vec3(0, -1, 0)).length(), 1e-15);
    EXPECT_LT((halfway({1, 0, 0}, {-1, 0, 0}) - Vec3(0, 0, -1)).length(), 1e-15);
    EXPECT_LT((halfway({0, 1, 1}, {0, -2, -2}) - Vec3(0, -1, 1).normalized()).length(), 1e-15);
    const Vec3 slanted = halfway({1, 2, 3}, {-0.1, -0.2, -0.3});
    EXPECT_NEAR(slanted.dot(Vec3(1, 2, 3)), 0, 1e-15);
    EXPECT_NEAR(slanted.dot(Vec3(1, 0, 0)), 0, 1e-15);
    // Not quite opposite: the shorter way, whatever that axis.
    EXPECT_LT((halfway({0, 1, 0}, {-1e-6, -1, 0}) - Vec3(-1, 0, 0)).length(), 1e-6);
  }
  const Keyed<Direction> step{{1, 3}, {{{0, 1, 0}}, {{0, -1, 0}}}, Interpolation::Step};
  EXPECT_EQ(value_at(step, 2.9), Vec3(0, 1, 0));
  EXPECT_EQ(value_at(step, 3), Vec3(0, -1, 0));
}

TEST(Keyed, SmoothDirectionsOnOneCircleTurnAsTheirAngleWould) {
  const std::vector<double> angles = {-20, 40, 60, 50, 50, 120};
  Keyed<double> angle{{0, 1, 3, 4, 6, 7}, angles, Interpolation::Smooth};
  Keyed<Direction> keyed{angle.frames, {}, Interpolation::Smooth};
  keyed.values.clear();
  for (const double degrees : angles) keyed.values.push_back(at_degrees(degrees));
  for (double frame = -1; frame < 8; frame += 0.03125) {
    EXPECT_NEAR(degrees_of(value_at(keyed, frame)), value_at(angle, frame), 1e-12) << frame;
  }
}

TEST(Keyed, SmoothDirectionsStayOnTheArcsAndSlowDownAtCorners) {
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const Keyed<Direction> keyed{{0, 1, 2}, {{x}, {y}, {z}}, Interpolation::Smooth};
  for (double frame = 0; frame <= 2; frame += 0.125) {
    const Vec3 value = value_at(keyed, frame);
    EXPECT_NEAR(value.length(), 1, 1e-15);
    EXPECT_NEAR(value[frame < 1 ? 2 : 0], 0, 1e-15);
    EXPECT_GE(value[frame < 1 ? 0 : 2], -1e-15);
  }
  EXPECT_LT((value_at(keyed, 1.001) - y).length(), 1e-4);  // at an even pace 1.6e-3
}

}  // namespace
}  // namespace lensplane
