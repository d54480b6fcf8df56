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

/// A layer of 3 x 3 pixels and one colour, whose coverage has an upright edge through the middle ones.
MapLayer cut_layer(const Rgba& colour, double distance, float left, float middle, float right) {
  MapLayer cut = layer(colour, distance);
  cut.map = {{3, 3, 0, 0, 3, 3}, false, std::vector<float>(9, 0.5F), std::vector<float>(9, 0.5F), {}};
  for (int row = 0; row < 3; ++row) cut.map.coverage.insert(cut.map.coverage.end(), {left, middle, right});
  cut.footprints.resize(9);
  return cut;
}

void expect_near(const Rgba& seen, const Rgba& right) {
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(seen[c], right[c], 1e-5) << c;
}

TEST(MapComposite, LayersCutByOneEdgeHideOneAnotherThere) {
  const MapLayer near = cut_layer(kRed, 10, 0, 0.5F, 1), far = cut_layer(kGreen, 20, 0, 0.5F, 1);
  expect_near(composite_from_maps({near, far}).at(1, 1), {0.5F, 0, 0, 0.5F});
}

TEST(MapComposite, LayersThatMeetAtAnEdgeLeaveNothingBetweenThem) {
  const MapLayer near = cut_layer(kRed, 10, 0, 0.25F, 1), far = cut_layer(kGreen, 20, 1, 0.75F, 0);
  expect_near(composite_from_maps({near, far}).at(1, 1), {0.25F, 0.75F, 0, 1});
}

TEST(MapComposite, EdgesThatCrossLeaveTheirProduct) {
  MapLayer near = cut_layer(kRed, 10, 0, 0.5F, 1);
  near.map.coverage = {0, 0, 0, 0.5F, 0.5F, 0.5F, 1, 1, 1};
  const MapLayer far = cut_layer(kGreen, 20, 0, 0.5F, 1);
  expect_near(composite_from_maps({near, far}).at(1, 1), {0.5F, 0.25F, 0, 0.75F});
}

/// At an edge the middle of the part that is covered is seen, not that of the pixel.
TEST(MapComposite, TheCoveredPartIsSeenAtAnEdge) {
  MapLayer ramp = cut_layer(kRed, 10, 0, 0.6F, 1);
  Picture picture{16, 1, 0, 0, 16, 1, {}};
  for (int i = 0; i < 16; ++i) picture.pixels.push_back({static_cast<float>(i) / 16, 0, 0, 1});
  ramp.look.texture = std::make_shared<const Texture>(picture, Wrap::Clamp);
  for (Footprint& footprint : ramp.footprints) footprint = {.ds_dx = 0.1, .dt_dy = -0.1};
  // The Gaussian's part to the right of where 0.6 of it lie: its middle is 0.29 pixels away.
  const Rgba seen = composite_from_maps({ramp}).at(1, 1);
  EXPECT_NEAR(seen[3], 0.6, 1e-5);
  EXPECT_NEAR(seen[0] / seen[3], 0.5 - 0.5 / 16 + 0.1 * 0.29, 0.003);
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
