// SPDX-License-Identifier: Apache-2.0
//
// A white, opaque picture is white and opaque wherever it is hit, by every path and under every footprint.

#include <gtest/gtest.h>

#include <random>

#include "pipeline/composite/compositor.h"
#include "pipeline/composite/elliptical_filter.h"
#include "tests/pipeline/composite/reference_filter.h"
#include "tests/pipeline/composite/tiled_file.h"
#include "tests/pipeline/temporary_folder.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

constexpr double kWhiteError = 1e-4;
constexpr Rgba kWhite{1, 1, 1, 1};

Picture white(int width, int height) {
  return painted(width, height, [](int, int) { return kWhite; });
}

/// Lookups anywhere, at the poles and far outside, of whole pixels and of parts, under footprints of 1e-6 to
/// 1e6 texels that are up to 1e12 times as long as wide.
void expect_white(const Texture& texture, const TextureCoordinates& middle, double spread, int lookups) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < lookups; ++i) {
    const TextureCoordinates st{middle.s + spread * (uniform(random) - 0.5),
                                middle.t + spread * (uniform(random) - 0.5)};
    const double major = std::pow(10, 12 * uniform(random) - 6);
    const double minor = major * std::pow(10, -12 * std::pow(uniform(random), 2));
    const double angle = i % 5 == 0 ? 0.0 : 2 * kPi * uniform(random);
    Footprint footprint = footprint_of(texture.windows(), major, minor, angle, 2 * kPi * uniform(random));
    footprint.scale = std::array{1.0, 1.0, 0.3, 1.0 / 3, 0.1}[static_cast<std::size_t>(i % 5)];
    const Rgba got = texture.filtered(st, footprint);
    for (const float channel : got) {
      ASSERT_NEAR(channel, 1, kWhiteError) << major << " x " << minor << " at " << angle << ", " << st.s
                                           << " " << st.t << " of " << texture.windows().display_width;
    }
  }
}

TEST(WhitePicture, StaysWhiteUnderEveryFootprint) {
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{
           {1, 1}, {1, 7}, {2, 1}, {3, 5}, {64, 33}, {512, 256}, {4096, 2048}, {2000, 3}}) {
    for (const Wrap wrap : {Wrap::Clamp, Wrap::Mirror, Wrap::Repeat, Wrap::Globe}) {
      const Texture texture(white(width, height), wrap);
      expect_white(texture, {0.5, 0.5}, 1, 300);
      expect_white(texture, {0.5, 0.5}, 4, 100);
      for (const double pole : {0.0, 1.0}) expect_white(texture, {0.5, pole}, 0.01, 100);
    }
  }
}

TEST(WhitePicture, StaysWhiteInTiles) {
  const TemporaryFolder folder;
  write_tiled(folder / "white.tx", white(512, 256), 64);
  const TiledTexture tiled(open_tiled_image(folder / "white.tx", std::size_t{1} << 20), float_pixels,
                           std::make_shared<TileCache>(std::size_t{8} << 20));
  for (const Wrap wrap : {Wrap::Clamp, Wrap::Repeat, Wrap::Globe}) {
    const Texture texture(tiled, wrap);
    expect_white(texture, {0.5, 0.5}, 1, 300);
    for (const double pole : {0.0, 1.0}) expect_white(texture, {0.5, pole}, 0.01, 100);
  }
}

TEST(WhitePicture, StaysWhiteOnBlackWhereTheFootprintHasRoom) {
  // Long ellipses that end well inside of a long picture.
  const Texture texture(white(16384, 256), Wrap::Black);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 500; ++i) {
    const double major = 3000 * uniform(random), minor = major * std::pow(10, -4 - 8 * uniform(random));
    const TextureCoordinates st{0.49 + 0.02 * uniform(random), 0.45 + 0.1 * uniform(random)};
    const Rgba got =
        texture.filtered(st, footprint_of(texture.windows(), major, minor, 0.006 * (uniform(random) - 0.5)));
    for (const float channel : got) ASSERT_NEAR(channel, 1, kWhiteError) << major << " x " << minor;
  }
}

TEST(WhitePicture, AMeanOfNothingIsTheNearestTexel) {
  const Pyramid pyramid = make_pyramid(painted(4, 4,
                                               [](int column, int row) {
                                                 return Rgba{float(column), float(row), 0, 1};
                                               }),
                                       Wrap::Clamp);
  PyramidTexels texels(pyramid, Wrap::Clamp);
  // No ellipse at all: a matrix that is none.
  const Rgba got = elliptical_mean(texels, 0, 1.6, 2.8, {0.4, 5, 0.4});
  EXPECT_EQ(got, (Rgba{2, 3, 0, 1}));
}

TEST(WhitePicture, EllipsesAreWidenedToWhatTexelsNeed) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 10000; ++i) {  // definite or not
    const double size = std::pow(10, 4 * uniform(random));
    const Covariance any{size * uniform(random), size * uniform(random), size * uniform(random)};
    const Covariance got = widened(any, 0.4);
    const double mean = (got.xx + got.yy) / 2, radius = std::hypot((got.xx - got.yy) / 2, got.xy);
    EXPECT_GE(mean - radius, 0.4 * (1 - 1e-9) - 1e-11 * size);
    const double mean_before = (any.xx + any.yy) / 2,
                 radius_before = std::hypot((any.xx - any.yy) / 2, any.xy);
    EXPECT_NEAR(mean + radius, std::max(0.4, mean_before + radius_before), 1e-9 * size);
  }
  const Covariance large{4, 1, 3}, kept = widened(large, 0.4);
  EXPECT_EQ(kept.xx, 4);
  EXPECT_EQ(kept.xy, 1);
  EXPECT_EQ(kept.yy, 3);
}

TEST(WhitePicture, IsWhiteAllRoundAHole) {
  // What is hit does not depend on what the sky looks like: a sky of one texel says how much of it is seen.
  Scene scene;
  scene.camera.width = 160;
  scene.camera.height = 90;
  scene.camera.fov_rad = 70 * kDegree;
  scene.lenses = {{1, {1, 0.5, -20}}};
  scene.surfaces = {LatLong{}};
  TraceSettings settings;
  settings.effects.jacobian = true;
  const Tracer tracer(scene, plan_trace(scene, settings));
  const auto taken = [&](int width, int height, int most) {
    const SurfaceLook look{std::make_shared<const Texture>(white(width, height), Wrap::Globe), {}};
    return composite(tracer, {look}, {.max = most}).picture;
  };
  for (const int most : {1, 64}) {
    const Picture expected = taken(1, 1, most);
    for (const auto& [width, height] : {std::pair{512, 256}, {4096, 2048}}) {
      const Picture got = taken(width, height, most);
      for (std::size_t i = 0; i < got.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
          ASSERT_NEAR(got.pixels[i][c], expected.pixels[i][c], kWhiteError) << i << " " << width;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lensplane
