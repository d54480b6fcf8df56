// SPDX-License-Identifier: Apache-2.0
//
// How fast textures are filtered: lookups per second of one thread, in an RGBA picture of 4096 x 2048.
//
// A walk over a film whose pixels see the texture under the footprint that the name says. `st_warp` is
// OpenImageIO's warp of the same picture by a map, which knows no footprint: the yardstick.

#include <OpenImageIO/imagebufalgo.h>
#include <benchmark/benchmark.h>

#include <cmath>

#include "pipeline/composite/texture.h"

namespace lensplane {
namespace {

constexpr int kWidth = 4096, kHeight = 2048;

Picture stripes() {
  Picture picture{kWidth, kHeight, 0, 0, kWidth, kHeight, {}};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const auto value = static_cast<float>(i % 251) / 250;
    picture.pixels.push_back({value, 1 - value, value / 2, 1});
  }
  return picture;
}

const Texture& texture() {
  static const Texture made(stripes(), Wrap::Globe);
  return made;
}

/// Pixels of `major` x `minor` texels, turned by `angle`; a film of 256 x 256 in the texture's middle.
void filtered(benchmark::State& state, double major, double minor, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Footprint footprint{.ds_dx = c * major / kWidth,
                            .ds_dy = -s * minor / kWidth,
                            .dt_dx = -s * major / kHeight,
                            .dt_dy = -c * minor / kHeight};
  std::int64_t lookups = 0;
  texture();
  for (auto _ : state) {
    for (int y = -128; y < 128; ++y) {
      for (int x = -128; x < 128; ++x) {
        // Long walks go on at the other side of the picture's inner half.
        const auto inside = [](double way) { return 0.5 + 0.5 * (way - std::round(way)); };
        const TextureCoordinates st{inside(x * footprint.ds_dx + y * footprint.ds_dy),
                                    inside(x * footprint.dt_dx + y * footprint.dt_dy)};
        benchmark::DoNotOptimize(texture().filtered(st, footprint));
      }
    }
    lookups += 256 * 256;
  }
  state.SetItemsProcessed(lookups);
}

void point(benchmark::State& state) {
  std::int64_t lookups = 0;
  texture();
  for (auto _ : state) {
    for (int y = 0; y < 256; ++y) {
      for (int x = 0; x < 256; ++x) {
        benchmark::DoNotOptimize(texture().lookup({0.3 + x * 0.3e-3, 0.3 + y * 0.5e-3}));
      }
    }
    lookups += 256 * 256;
  }
  state.SetItemsProcessed(lookups);
}

void st_warp(benchmark::State& state) {
  OIIO::ImageBuf source(OIIO::ImageSpec(kWidth, kHeight, 4, OIIO::TypeDesc::FLOAT));
  const Picture picture = stripes();
  source.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, picture.pixels.data());
  OIIO::ImageBuf map(OIIO::ImageSpec(256, 256, 2, OIIO::TypeDesc::FLOAT));
  const auto texels_per_pixel = static_cast<double>(state.range(0));
  for (OIIO::ImageBuf::Iterator<float> pixel(map); !pixel.done(); ++pixel) {
    pixel[0] = static_cast<float>(0.4 + pixel.x() * texels_per_pixel / kWidth);
    pixel[1] = static_cast<float>(0.4 + pixel.y() * texels_per_pixel / kHeight);
  }
  for (auto _ : state) {
    OIIO::ImageBuf warped;
    OIIO::ImageBufAlgo::st_warp(warped, source, map, "triangle", 0.0f, 0, 1, false, false, {}, 1);
    benchmark::DoNotOptimize(warped.localpixels());
  }
  state.SetItemsProcessed(state.iterations() * 256 * 256);
}

void pyramid(benchmark::State& state) {
  const Picture picture = stripes();
  for (auto _ : state) benchmark::DoNotOptimize(make_pyramid(picture, Wrap::Globe).levels.size());
}

BENCHMARK(point);
BENCHMARK_CAPTURE(filtered, identity, 1, 1, 0);
BENCHMARK_CAPTURE(filtered, sheared_near_identity, 1.2, 0.9, 0.4);
BENCHMARK_CAPTURE(filtered, minified_2, 2, 2, 0);
BENCHMARK_CAPTURE(filtered, minified_8, 8, 8, 0);
BENCHMARK_CAPTURE(filtered, magnified_8, 0.125, 0.125, 0);
BENCHMARK_CAPTURE(filtered, anisotropic_100, 200, 2, 0.5);
BENCHMARK_CAPTURE(filtered, arc_magnified_100_along, 1, 0.01, 0.5);
BENCHMARK(st_warp)->Arg(1)->Arg(2);
BENCHMARK(pyramid)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lensplane
