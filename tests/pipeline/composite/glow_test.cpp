// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/glow.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
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

TEST(Glow, ConstantLightStaysConstant) {
  for (const auto& [width, height] : {std::pair{701, 500}, {64, 64}, {130, 67}, {2, 1}, {1, 7}, {3, 200}}) {
    for (const double radius : {2.0, 40.0}) {
      for (const Projection projection : {Projection::Perspective, Projection::LatLong}) {
        Picture picture = filled(width, height, {0.5F, 0.25F, 0, 0.75F});
        if (width > 100) picture.x = picture.y = -3, picture.display_width -= 6, picture.display_height -= 6;
        const Picture glowing = with_glow(picture, {0.9, radius, projection});
        float least = 1, most = 0;
        for (const Rgba& pixel : glowing.pixels) {
          least = std::min(least, pixel[0]), most = std::max(most, pixel[0]);
          ASSERT_NEAR(pixel[1], 0.25, 1e-5);
          ASSERT_EQ(pixel[2], 0);
          ASSERT_EQ(pixel[3], 0.75F);
        }
        EXPECT_NEAR(least, 0.5, 1e-5) << width << " " << radius;
        EXPECT_NEAR(most, 0.5, 1e-5) << width << " " << radius;
      }
    }
  }
}

/// Beyond the frame light goes on as its edge has it.
TEST(Glow, TheEdgeGoesOnBeyondTheFrame) {
  constexpr int kWidth = 90, kHeight = 70, kAround = 256;
  Picture small = filled(kWidth, kHeight, {0, 0, 0, 1});
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column)
      small.at(column, row)[0] = static_cast<float>(1 + std::sin(0.2 * column) * std::cos(0.1 * row * row));
  }
  Picture large = filled(kWidth + 2 * kAround, kHeight + 2 * kAround, {0, 0, 0, 1});
  for (int row = 0; row < large.height; ++row) {
    for (int column = 0; column < large.width; ++column)
      large.at(column, row) =
          small.at(std::clamp(column - kAround, 0, kWidth - 1), std::clamp(row - kAround, 0, kHeight - 1));
  }
  const Picture a = with_glow(small, {1, 5}), b = with_glow(large, {1, 5});
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column)
      ASSERT_NEAR(a.at(column, row)[0], b.at(column + kAround, row + kAround)[0], 3e-3)
          << column << " " << row;
  }
}

/// A bright pixel and its veil on a lat-long picture are the same wherever the picture is cut.
TEST(Glow, GoesRoundTheSphereAndOverItsPoles) {
  for (const int width : {256, 200}) {
    const int height = width / 2;
    const auto veil = [&](int column, int row) {
      return with_glow(point(width, height, column, row), {1, 6, Projection::LatLong});
    };
    const Picture middle = veil(width / 2, 20), cut = veil(0, 20);
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const float there = middle.at((column + width / 2) % width, row)[0];
        ASSERT_NEAR(cut.at(column, row)[0], there, 0.02 * there) << column << " " << row;
      }
    }
    // Light at the upper edge goes over the pole: half the way round it is as bright there as below.
    const Picture pole = veil(width / 4, 0);
    for (int away = 1; away < 12; ++away) {
      const float beyond = pole.at(3 * width / 4, away - 1)[0], below = pole.at(width / 4, away)[0];
      EXPECT_NEAR(beyond / below, 1, 2 * kGlowError) << away;
    }
    double sum = 0;
    for (const Rgba& pixel : cut.pixels) sum += pixel[0];
    EXPECT_NEAR(sum, 1000, width == 256 ? 1 : 25);  // none is lost, but where the veil is resampled
  }
}

TEST(Glow, OverscanOfALatLongShowsTheSameOnceMore) {
  Picture picture = filled(276, 148, {0, 0, 0, 1});
  picture.x = picture.y = -10;
  picture.display_width = 256, picture.display_height = 128;
  picture.at(12, 40) = picture.at(268, 40) = {1000, 500, 0, 1};  // column 2, once more beyond the right edge
  const Picture glowing = with_glow(picture, {1, 6, Projection::LatLong});
  for (int column = 0; column < 20; ++column) {
    EXPECT_EQ(glowing.at(column, 40), glowing.at(column + 256, 40)) << column;
  }
}

TEST(Glow, OfAFisheyeStaysInTheCircleAndKeepsItsRim) {
  constexpr int kSize = 120;
  Picture picture = filled(kSize + 20, kSize, {0, 0, 0, 0});
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const double away = std::hypot(column + 0.5 - 70, row + 0.5 - 60);
      const auto share = static_cast<float>(std::clamp(60.5 - away, 0.0, 1.0));
      picture.at(column, row) = {share, share, share, share};
    }
  }
  const Picture glowing = with_glow(picture, {0.3, 5, Projection::Fisheye});
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    ASSERT_NEAR(glowing.pixels[i][0], picture.pixels[i][0], 1e-5);
  }
}

/// More black around a picture whose edges are black changes nothing in it: light that leaves the frame is
/// lost there and nowhere else.
TEST(Glow, ABlackEdgeOnlyCutsOff) {
  constexpr int kAround = 256;  // a whole number of pixels of all sizes that matter
  Picture small = point(128, 128, 1, 1);
  for (int row = 1; row < 127; ++row) small.at(126, row) = {3, 2, 1, 1};
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

TEST(Glow, DoesNotDependOnTheNumberOfThreads) {
  const Picture many = with_glow(point(300, 200, 77, 91), {0.3, 9});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(with_glow(point(300, 200, 77, 91), {0.3, 9}).pixels, many.pixels);
}

}  // namespace
}  // namespace lensplane
