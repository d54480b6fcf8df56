// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/map_composite.h"

#include <gtest/gtest.h>

#include <limits>

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Rgba kRed{1, 0, 0, 1}, kGreen{0, 1, 0, 1}, kBlue{0, 0, 1, 1};

/// A layer of one pixel and one colour.
MapLayer layer(const Rgba& colour, double distance, float coverage = 1) {
  MapLayer layer;
  layer.map = {1, 1, 0, 0, 1, 1, false, {0.5F}, {0.5F}, {coverage}};
  layer.footprints = {{}};
  layer.look.texture = std::make_shared<const Texture>(Picture{1, 1, 0, 0, 1, 1, {colour}}, Wrap::Clamp);
  layer.distance = distance;
  return layer;
}

Rgba seen(const std::vector<MapLayer>& layers) {
  return composite_from_maps(layers).at(0, 0);
}

TEST(MapComposite, NearerLayersLieOverFartherOnes) {
  EXPECT_EQ(seen({layer(kRed, 10), layer(kGreen, 20)}), kRed);
  EXPECT_EQ(seen({layer(kGreen, 20), layer(kRed, 10)}), kRed);
  EXPECT_EQ(seen({layer(kGreen, 20), layer(kRed, 20)}), kRed);
}

TEST(MapComposite, DepthGoesBeforeTheDistanceOfTheWhole) {
  MapLayer bent = layer(kRed, 10);
  bent.depth = {30};
  EXPECT_EQ(seen({bent, layer(kGreen, 20)}), kGreen);
  bent.depth = {std::numeric_limits<float>::max()};
  EXPECT_EQ(seen({bent, layer(kGreen, 1e300)}), kGreen);
  bent.depth = {0};  // no depth was traced here
  EXPECT_EQ(seen({bent, layer(kGreen, 20)}), kRed);
}

TEST(MapComposite, SkiesLieBehindAllElse) {
  MapLayer sky = layer(kBlue, kInfinity);
  sky.surface = LatLong{};
  EXPECT_EQ(seen({layer(kRed, kInfinity), sky}), kRed);
  EXPECT_EQ(seen({sky, layer(kRed, kInfinity)}), kRed);
}

TEST(MapComposite, CoverageCountsLikeAlpha) {
  EXPECT_EQ(seen({layer(kGreen, 20), layer(kRed, 10, 0.25F)}), (Rgba{0.25F, 0.75F, 0, 1}));
  EXPECT_EQ(seen({layer(kRed, 10, 0.25F)}), (Rgba{0.25F, 0, 0, 0.25F}));
  EXPECT_EQ(seen({layer(kGreen, 20), layer(kRed, 10, 0)}), kGreen);
}

TEST(MapComposite, LightFallsOnSpheres) {
  MapLayer lit = layer(kRed, 10);
  lit.surface = Sphere{};
  lit.look.light = sphere_normal_from_st({0.5, 0.5});
  EXPECT_NEAR(seen({lit})[0], 1, 1e-6);
  lit.look.light = -*lit.look.light;
  EXPECT_EQ(seen({lit})[0], 0);
  EXPECT_EQ(seen({lit})[3], 1);
}

TEST(MapComposite, ThePictureHasTheMapsWindows) {
  MapLayer wide = layer(kRed, 10);
  wide.map = {2,
              3,
              -1,
              -1,
              1,
              2,
              false,
              std::vector<float>(6, 0.5F),
              std::vector<float>(6, 0.5F),
              std::vector<float>(6, 1)};
  wide.footprints.resize(6);
  const Picture picture = composite_from_maps({wide});
  EXPECT_EQ(picture.x, -1);
  EXPECT_EQ(picture.display_height, 2);
  EXPECT_EQ(picture.pixels.size(), 6U);
}

}  // namespace
}  // namespace lensplane
