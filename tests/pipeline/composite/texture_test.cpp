// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/texture.h"

#include <gtest/gtest.h>

#include <random>

#include <cmath>

namespace lensplane {
namespace {

/// Pixels with their column in red and their row in green.
Picture numbered(int width, int height) {
  Picture picture{width, height, 0, 0, width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      picture.pixels.push_back({static_cast<float>(column), static_cast<float>(row), 0, 1});
    }
  }
  return picture;
}

TextureCoordinates centre_of(int column, int row, int width, int height) {
  return {(column + 0.5) / width, 1 - (row + 0.5) / height};
}

TEST(Texture, PixelCentresReturnTheirPixels) {
  for (const Wrap wrap : {Wrap::Black, Wrap::Clamp, Wrap::Mirror, Wrap::Repeat, Wrap::Globe}) {
    const Texture texture(numbered(8, 4), wrap);
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 8; ++column) {
        const Rgba colour = texture.lookup(centre_of(column, row, 8, 4));
        EXPECT_NEAR(colour[0], column, 1e-5);
        EXPECT_NEAR(colour[1], row, 1e-5);
        EXPECT_EQ(colour[3], 1);
      }
    }
  }
}

TEST(Texture, BetweenCentresRampsGoOn) {
  const Texture texture(numbered(8, 4), Wrap::Clamp);
  const Rgba colour = texture.lookup({(2.5 + 0.25) / 8, 1 - (1.5 + 0.5) / 4});
  EXPECT_NEAR(colour[0], 2.25, 1e-5);
  EXPECT_NEAR(colour[1], 1.5, 1e-5);
}

TEST(Texture, BetweenCentresItIsCatmullAndRomsCubic) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(0, 1);
  Picture picture{8, 6, 0, 0, 8, 6, {}};
  for (int i = 0; i < 48; ++i) picture.pixels.push_back({uniform(random), uniform(random), 0, 1});
  const auto cubic = [](double x) {
    const double r = std::abs(x);
    return r < 1   ? 1 - 2.5 * r * r + 1.5 * r * r * r
           : r < 2 ? 2 - 4 * r + 2.5 * r * r - 0.5 * r * r * r
                   : 0.0;
  };
  const Texture texture(picture, Wrap::Clamp);
  for (int i = 0; i < 100; ++i) {
    const double x = 1 + 5 * uniform(random), y = 1 + 3 * uniform(random);  // from the first texel's centre
    const Rgba got = texture.lookup({(x + 0.5) / 8, 1 - (y + 0.5) / 6});
    for (std::size_t c = 0; c < 2; ++c) {
      double expected = 0;
      for (int row = 0; row < 6; ++row) {
        for (int column = 0; column < 8; ++column) {
          expected += cubic(column - x) * cubic(row - y) * static_cast<double>(picture.at(column, row)[c]);
        }
      }
      EXPECT_NEAR(got[c], expected, 1e-5);
    }
  }
}

TEST(Texture, OutsideItIsAsTheEdgeSays) {
  const auto red = [](Wrap wrap, int column) {
    return Texture(numbered(8, 4), wrap).lookup(centre_of(column, 1, 8, 4))[0];
  };
  EXPECT_EQ(Texture(numbered(8, 4), Wrap::Black).lookup(centre_of(-2, 1, 8, 4)), (Rgba{0, 0, 0, 0}));
  EXPECT_NEAR(red(Wrap::Clamp, -2), 0, 1e-5);
  EXPECT_NEAR(red(Wrap::Clamp, 11), 7, 1e-5);
  EXPECT_NEAR(red(Wrap::Mirror, -1), 0, 1e-5);
  EXPECT_NEAR(red(Wrap::Mirror, -3), 2, 1e-5);
  EXPECT_NEAR(red(Wrap::Mirror, 9), 6, 1e-5);
  EXPECT_NEAR(red(Wrap::Mirror, 17), 1, 1e-5);
  EXPECT_NEAR(red(Wrap::Repeat, -1), 7, 1e-5);
  EXPECT_NEAR(red(Wrap::Repeat, 9), 1, 1e-5);
}

TEST(Texture, BlackFadesWithinHalfAPixelOfTheEdge) {
  const Texture texture(numbered(8, 4), Wrap::Black);
  EXPECT_NEAR(texture.lookup({0, 0.5})[3], 0.5, 1e-6);
  // Catmull and Rom's weights at 3/4 of the way from the black to the first column, and of the next column.
  EXPECT_NEAR(texture.lookup({0.25 / 8, 0.5})[3], 0.8671875 - 0.0703125, 1e-6);
  EXPECT_EQ(texture.lookup({-0.5 / 8, 0.5})[3], 0);
}

TEST(Texture, GlobeGoesRoundInLongitudeAndOverThePoles) {
  const Texture texture(numbered(8, 4), Wrap::Globe);
  // Half way between the last column and the first.
  EXPECT_NEAR(texture.lookup(centre_of(-1, 1, 8, 4))[0], 7, 1e-5);
  EXPECT_NEAR(texture.lookup({1.0, 0.5})[0], 3.5, 1e-5);
  EXPECT_NEAR(texture.lookup({0.0, 0.5})[0], 3.5, 1e-5);
  // At the pole columns that are half a turn apart meet: 1 and 5.
  const Rgba pole = texture.lookup({1.5 / 8, 1.0});
  EXPECT_NEAR(pole[0], 3, 1e-5);
  EXPECT_NEAR(pole[1], -0.125, 1e-5);  // between rows of 1, 0, 0 and 1 the cubic swings out: -1/16 of each 1
}

TEST(Texture, OverscanIsUsedWhereTheDisplayWindowEnds) {
  Picture picture = numbered(8, 4);
  picture.x = -2;
  picture.y = -1;
  picture.display_width = 4;
  picture.display_height = 2;
  const Texture texture(picture, Wrap::Black);
  EXPECT_NEAR(texture.lookup(centre_of(0, 0, 4, 2))[0], 2, 1e-5);
  EXPECT_NEAR(texture.lookup(centre_of(-2, 0, 4, 2))[0], 0, 1e-5);
  EXPECT_NEAR(texture.lookup(centre_of(5, 2, 4, 2))[1], 3, 1e-5);
  EXPECT_EQ(texture.lookup(centre_of(7, 0, 4, 2))[3], 0);
}

TEST(Texture, CropIsTransparentWhereItHasNoPixels) {
  Picture crop = numbered(4, 2);
  crop.x = 2;
  crop.y = 1;
  crop.display_width = 8;
  crop.display_height = 4;
  for (const Wrap wrap : {Wrap::Black, Wrap::Clamp, Wrap::Mirror, Wrap::Repeat, Wrap::Globe}) {
    const Texture texture(crop, wrap);
    EXPECT_NEAR(texture.lookup(centre_of(3, 2, 8, 4))[0], 1, 1e-5);
    EXPECT_EQ(texture.lookup(centre_of(0, 2, 8, 4)), (Rgba{0, 0, 0, 0}));
    EXPECT_EQ(texture.lookup(centre_of(7, 0, 8, 4)), (Rgba{0, 0, 0, 0}));
    EXPECT_EQ(texture.lookup(centre_of(-1, 2, 8, 4))[3], 0);
  }
  EXPECT_NEAR(Texture(crop, Wrap::Repeat).lookup(centre_of(11, 2, 8, 4))[0], 1, 1e-5);
}

TEST(Texture, FarAwayItIsStillFinite) {
  for (const Wrap wrap : {Wrap::Black, Wrap::Clamp, Wrap::Mirror, Wrap::Repeat, Wrap::Globe}) {
    const Texture texture(numbered(8, 4), wrap);
    for (const double far : {1e9, -1e9, 1e300, -1e300}) {
      for (const float channel : texture.lookup({far, far})) EXPECT_TRUE(std::isfinite(channel));
    }
  }
}

}  // namespace
}  // namespace lensplane
