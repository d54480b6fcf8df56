// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/edge_pixel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace lensplane {
namespace {

// Sixteen sums of floats.
constexpr float kRounding = 1e-6F;

constexpr Rgba grey(float light) {
  return {light, light, light, 1};
}

const std::vector<SeenPoint> kNear = {{true, 1, {0, 0}, {}}, {true, 2, {0, 0}, {}}};
const std::vector<SeenPoint> kCrossed = {{true, 2, {0, 0}, {}}, {true, 1, {0, 0}, {}}};
const std::vector<SeenPoint> kOneMissed = {{true, 1, {0, 0}, {}}, {}};

/// A pixel of 16 rays, of which number n has the colour `colour(n)`; the last one meets `last`.
EdgePixel pixel_of(const std::function<Rgba(int)>& colour, const std::vector<SeenPoint>& last = kNear,
                   PixelKind kind = PixelKind::Curved) {
  EdgePixel pixel(3, 4, kind, 2);
  for (int n = 0; n < 16; ++n) pixel.add(n < 15 ? kNear : last, colour(n));
  return pixel;
}

TEST(EdgePixel, IsTheMeanOfItsRays) {
  const EdgePixel pixel = pixel_of([](int n) { return grey(n < 4 ? 1 : 0); }, kOneMissed);
  EXPECT_EQ(pixel.mean(), grey(0.25F));
  EXPECT_EQ(pixel.share_of(0), 1);
  EXPECT_EQ(pixel.share_of(1), 15.0 / 16);
  EXPECT_EQ(pixel.column(), 3);
  EXPECT_EQ(pixel.row(), 4);
}

TEST(EdgePixel, RaysThatDoNotCountAreThereForTheErrorAlone) {
  EdgePixel pixel(0, 0, PixelKind::Curved, 2), none(0, 0, PixelKind::Curved, 2);
  for (int n = 0; n < 16; ++n) {
    pixel.add(n < 4 ? kOneMissed : kNear, grey(n < 4 ? 1 : 0.5F), 0, n >= 4);
    none.add(kNear, grey(n < 8 ? 1 : 0), 0, false);
  }
  EXPECT_EQ(pixel.mean(), grey(0.5F));
  EXPECT_EQ(pixel.share_of(1), 1);
  EXPECT_GT(pixel.error(), 0);
  EXPECT_EQ(none.mean(), grey(0.5F));
  EXPECT_EQ(none.share_of(0), 0);
}

TEST(EdgePixel, GroupsThatDifferTellTheError) {
  // Groups of means 0, 0, 0 and 1, as seen 0 and 1/1.18; their mean .25, as seen .25/.43.
  const EdgePixel pixel = pixel_of([](int n) { return grey(n < 4 ? 1 : 0); });
  const float all = 0.25F / 0.43F, one = 1 / 1.18F;
  EXPECT_NEAR(pixel.error(), std::sqrt((3 * all * all + (one - all) * (one - all)) / 12), kRounding);
}

TEST(EdgePixel, AJumpHasAFloorWhereGroupsAgreeByChance) {
  const auto every_other = [](int n) { return grey(n % 2 == 0 ? 1 : 0); };
  const auto floor = static_cast<float>(kFirstEdgeError) / 1.18F;
  EXPECT_NEAR(pixel_of(every_other).error(), floor, kRounding);
  EXPECT_NEAR(pixel_of(every_other, kOneMissed).error(), floor, kRounding);
  // In four steps from black to white as seen the widest gap is a third of it.
  const auto steps = [](int n) {
    const float seen = static_cast<float>(n % 4) / 3 / 1.18F;
    return grey(kMiddleGrey * seen / (1 - seen));
  };
  EXPECT_NEAR(pixel_of(steps).error(), floor / 3, kRounding);
  // Rays that meet other things, or the same in another order, are two sides of an edge.
  EXPECT_NEAR(pixel_of(steps, kOneMissed).error(), floor, kRounding);
  EXPECT_NEAR(pixel_of(steps, kCrossed).error(), floor, kRounding);
}

TEST(EdgePixel, ASilhouetteThatNoRayHasFoundMayBeAnything) {
  const auto same = [](int) { return grey(0.5F); };
  EXPECT_FLOAT_EQ(pixel_of(same, kNear, PixelKind::Silhouette).error(), static_cast<float>(kFirstEdgeError));
  EXPECT_EQ(pixel_of(same, kOneMissed, PixelKind::Silhouette).error(), 0);
}

TEST(EdgePixel, NothingIsLeftToChanceWhereAllSeeTheSame) {
  EXPECT_EQ(pixel_of([](int) { return grey(0.5F); }).error(), 0);
  EdgePixel few(0, 0, PixelKind::Curved, 2);
  for (int n = 0; n < 4; ++n) few.add(kNear, grey(n < 2 ? 1 : 0));
  EXPECT_EQ(few.error(), 0);
}

TEST(EdgePixel, BrightnessIsSeenAroundMiddleGrey) {
  EXPECT_EQ(seen_brightness(0), 0);
  EXPECT_FLOAT_EQ(seen_brightness(kMiddleGrey), 0.5F);
  EXPECT_FLOAT_EQ(seen_brightness(9 * kMiddleGrey), 0.9F);
  EXPECT_FLOAT_EQ(seen_brightness(-kMiddleGrey), -0.5F);
}

}  // namespace
}  // namespace lensplane
