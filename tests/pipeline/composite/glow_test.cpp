// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/glow.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace lensplane {
namespace {

Picture filled(int width, int height, const Rgba& colour) {
  return {width,
          height,
          0,
          0,
          width,
          height,
          UnsetVector<Rgba>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), colour)};
}

/// A single bright pixel on black.
Picture point(int width, int height, int column, int row) {
  Picture picture = filled(width, height, {0, 0, 0, 1});
  picture.at(column, row) = {1000, 500, 0, 1};
  return picture;
}

/// Share of the point-spread that falls on the pixel (dx, dy) away, by four points in it.
double spread(double radius, double dx, double dy) {
  const double r0 = radius / std::sqrt(3.0);
  double sum = 0;
  for (const double x : {dx - 0.25, dx + 0.25}) {
    for (const double y : {dy - 0.25, dy + 0.25})
      sum += r0 / (2 * std::acos(-1.0) * std::pow(x * x + y * y + r0 * r0, 1.5)) / 4;
  }
  return sum;
}

TEST(Glow, FollowsItsPointSpread) {
  constexpr int kSize = 801, kMiddle = 400;
  for (const double radius : {10.0, 15.0}) {
    const Picture glowing = with_glow(point(kSize, kSize, kMiddle, kMiddle), {1, radius});
    for (int away = 0; away <= std::min(30 * static_cast<int>(radius), 390); away += away < 20 ? 1 : 15) {
      const double expected = 1000 * spread(radius, away, 0);
      EXPECT_NEAR(glowing.at(kMiddle + away, kMiddle)[0] / expected, 1, kGlowError) << radius << " " << away;
      const double diagonal = 1000 * spread(radius, away, away);
      EXPECT_NEAR(glowing.at(kMiddle - away, kMiddle + away)[0] / diagonal, 1, kGlowError)
          << radius << " " << away;
    }
  }
}

/// Of all the light, what the point-spread puts outside of the frame is lost, and no more.
TEST(Glow, KeepsTheLightThatStaysInTheFrame) {
  constexpr int kSize = 1001, kMiddle = 500;
  constexpr double kRadius = 8;
  const Picture glowing = with_glow(point(kSize, kSize, kMiddle, kMiddle), {0.4, kRadius});
  double sum = 0;
  for (const Rgba& pixel : glowing.pixels) sum += pixel[0];
  // The share of P within a square of half side a: 1 - 4/(2 pi) (angle whose tangent is r0 sqrt(2 a^2 + r0^2)
  // / a^2).
  const double a = kSize / 2.0, r0 = kRadius / std::sqrt(3.0);
  const double inside = 1 - std::atan(r0 * std::sqrt(2 * a * a + r0 * r0) / (a * a)) * 2 / std::acos(-1.0);
  EXPECT_NEAR(sum / 1000, 1 - 0.4 * (1 - inside), 1e-4);
}

TEST(Glow, ConstantLightStaysConstantFarFromTheEdges) {
  const Picture glowing = with_glow(filled(700, 500, {0.5F, 0.25F, 0, 0.75F}), {0.2, 3});
  const Rgba& middle = glowing.at(350, 250);
  // What the point-spread takes from beyond the frame is missing: r0 / distance of the share.
  EXPECT_NEAR(middle[0], 0.5, 0.5 * 0.2 * 0.012);
  EXPECT_LT(middle[0], 0.5);
  EXPECT_NEAR(middle[1] / middle[0], 0.5, 1e-5);
  EXPECT_EQ(middle[2], 0);
  EXPECT_EQ(middle[3], 0.75F);
  EXPECT_NEAR(glowing.at(0, 250)[0], 0.5 * 0.9, 0.01);  // at an edge half of the veil is missing
}

/// Black around a picture changes nothing in it: light that leaves the frame is lost there and nowhere else.
TEST(Glow, TheEdgeOfTheFrameOnlyCutsOff) {
  constexpr int kAround = 256;  // a whole number of pixels of all sizes that matter
  Picture small = point(128, 128, 0, 0);
  for (int row = 0; row < 128; ++row) small.at(127, row) = {3, 2, 1, 1};
  Picture large = filled(128 + 2 * kAround, 128 + 2 * kAround, {0, 0, 0, 1});
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column)
      large.at(column + kAround, row + kAround) = small.at(column, row);
  }
  const Picture a = with_glow(small, {1, 8}), b = with_glow(large, {1, 8});
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column) {
      const float within = a.at(column, row)[0], around = b.at(column + kAround, row + kAround)[0];
      ASSERT_NEAR(within / around, 1, 1e-4) << column << " " << row;
    }
  }
}

TEST(Glow, IsSymmetricWhereverThePointIs) {
  for (const auto& [column, row] : {std::pair{100, 60}, {101, 60}, {101, 63}}) {
    const Picture glowing = with_glow(point(201, 123, column, row), {0.5, 4});
    for (int away = 1; away < 40; ++away) {
      const float right = glowing.at(column + away, row)[0], left = glowing.at(column - away, row)[0];
      const float below = glowing.at(column, row + away)[0], above = glowing.at(column, row - away)[0];
      EXPECT_NEAR(left / right, 1, kGlowError) << away;
      EXPECT_NEAR(below / right, 1, kGlowError) << away;
      EXPECT_NEAR(above / below, 1, kGlowError) << away;
    }
  }
}

TEST(Glow, LightIsTakenFromTheOverscan) {
  Picture picture = point(120, 80, 5, 40);
  picture.x = picture.y = -10;
  picture.display_width = 100;
  picture.display_height = 60;
  const Picture glowing = with_glow(picture, {0.5, 4});
  EXPECT_EQ(glowing.x, -10);
  EXPECT_GT(glowing.at(12, 40)[0], 0.1F);
}

TEST(Glow, WorksOnPicturesOfAnySize) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 7}, {3, 200}}) {
    const Picture glowing = with_glow(filled(width, height, {1, 1, 1, 1}), {0.5, 2});
    for (const Rgba& pixel : glowing.pixels) {
      EXPECT_GE(pixel[0], 0.5F);
      EXPECT_LE(pixel[0], 1.0F);
    }
  }
}

TEST(Glow, DoesNotDependOnTheNumberOfThreads) {
  const Picture many = with_glow(point(300, 200, 77, 91), {0.3, 9});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(with_glow(point(300, 200, 77, 91), {0.3, 9}).pixels, many.pixels);
}

}  // namespace
}  // namespace lensplane
