// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/true_pixels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pipeline/composite/compositor.h"

namespace lensplane {
namespace {

constexpr int kWidth = 64, kHeight = 48;

Tracer tracer_of(const Scene& scene) {
  TraceSettings settings;
  settings.effects.jacobian = true;
  return {scene, plan_trace(scene, settings)};
}

Scene plain_scene() {
  Scene scene;
  scene.camera.width = kWidth;
  scene.camera.height = kHeight;
  scene.camera.fov_rad = 0.1;
  scene.surfaces = {Plate{}};
  return scene;
}

/// A plate of `per_pixel` x `per_pixel` texels a pixel, white from film column `edge` on.
SurfaceLook plate_with_edge(double edge, int per_pixel) {
  Picture picture{kWidth * per_pixel, kHeight * per_pixel, 0, 0, kWidth * per_pixel, kHeight * per_pixel, {}};
  for (int i = 0; i < picture.width * picture.height; ++i) {
    const float v = i % picture.width + 0.5 > edge * per_pixel ? 1.0F : 0.0F;
    picture.pixels.push_back({v, v, v, 1});
  }
  return {std::make_shared<const Texture>(std::move(picture), Wrap::Clamp)};
}

TEST(TruePixels, AreTheSurfaceUnderThePixelFilter) {
  const Scene scene = plain_scene();
  const double edge = 24.25;
  const Tracer tracer = tracer_of(scene);
  const auto tiles = true_tiles(tracer, {plate_with_edge(edge, 16)}, 4, 16);
  ASSERT_EQ(tiles.size(), 12U);  // no more than lie side by side
  for (const TrueTile& tile : tiles) {
    for (int i = 0; i < tile.size * tile.size; ++i) {
      // A step seen by a Gaussian.
      const double centre = tile.left + i % tile.size + 0.5;
      const double share = 0.5 * std::erfc((edge - centre) / kPixelSigma / std::sqrt(2.0));
      EXPECT_NEAR(tile.pixels[static_cast<std::size_t>(i)][0], share, 3e-3) << centre;
      EXPECT_NEAR(tile.pixels[static_cast<std::size_t>(i)][3], 1, 1e-5);
    }
  }
}

TEST(TruePixels, MorePixelsThanFitAreNotAskedFor) {
  Scene scene = plain_scene();
  scene.camera.width = 7;
  scene.camera.height = 5;
  const Tracer tracer = tracer_of(scene);
  const auto tiles = true_tiles(tracer, {plate_with_edge(3, 1)}, 8, 2);
  ASSERT_EQ(tiles.size(), 1U);
  EXPECT_EQ(tiles[0].size, 5);
}

TEST(TruePixels, PsnrIsThatOfTheTilesPixels) {
  Scene scene = plain_scene();
  scene.camera.overscan = 4;  // which is not compared
  Picture picture = blank_picture(scene.camera);
  const std::vector<TrueTile> truth = {
      {10, 20, 2, {{0.5F, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}}};
  picture.at(10 + 4, 20 + 4) = {0.4F, 0, 0, 1};
  picture.at(0, 0) = {9, 9, 9, 1};
  // Off by 0.1 in one of twelve channels; the peak is 0.5.
  EXPECT_NEAR(psnr_of(picture, truth), 10 * std::log10(0.25 / (0.01 / 12)), 1e-4);
  picture.at(14, 24) = {0.5F, 0, 0, 1};
  EXPECT_EQ(psnr_of(picture, truth), kLargestPsnr);
  picture.at(14, 24)[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(psnr_of(picture, truth), 0);
}

TEST(TruePixels, ThePictureItselfComesNear) {
  const Scene scene = plain_scene();
  const Tracer tracer = tracer_of(scene);
  const std::vector<SurfaceLook> looks = {plate_with_edge(24.25, 4)};
  const auto truth = true_tiles(tracer, looks, 4, 16);
  EXPECT_GT(psnr_of(composite(tracer, looks, {}).picture, truth), 45);
}

}  // namespace
}  // namespace lensplane
