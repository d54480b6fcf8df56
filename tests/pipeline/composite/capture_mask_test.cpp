// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/capture_mask.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lensplane {
namespace {

TEST(CaptureMask, FindsRimsWithinTwoPixelsAndTheWayOut) {
  CaptureMask mask(8, 4);
  EXPECT_TRUE(mask.rim_pixels().empty());
  for (int row = -2; row < 6; ++row) {
    for (int column = -2; column < 3; ++column) mask.set_captured(column, row);
  }
  const auto pixels = mask.rim_pixels();
  ASSERT_EQ(pixels.size(), 4U * 4U);  // columns 1 to 4
  for (const auto& pixel : pixels) {
    EXPECT_GE(pixel.column, 1);
    EXPECT_LE(pixel.column, 4);
    EXPECT_EQ(pixel.x, 1);
    EXPECT_EQ(pixel.y, 0);
  }
}

TEST(CaptureMask, KnowsTwoPixelsBeyondTheRectangle) {
  CaptureMask mask(5, 5);
  mask.set_captured(-2, -2);
  const auto pixels = mask.rim_pixels();
  ASSERT_EQ(pixels.size(), 1U);
  EXPECT_EQ(pixels[0].column, 0);
  EXPECT_EQ(pixels[0].row, 0);
  EXPECT_DOUBLE_EQ(pixels[0].x, std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(pixels[0].y, std::sqrt(0.5));
  for (int row = -2; row < 7; ++row) {
    for (int column = -2; column < 7; ++column) mask.set_captured(column, row);
  }
  EXPECT_TRUE(mask.rim_pixels().empty());
}

}  // namespace
}  // namespace lensplane
