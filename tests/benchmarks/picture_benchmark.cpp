// SPDX-License-Identifier: Apache-2.0
//
// What a picture costs: a plate of 3840 x 2160 RGBA floats behind three masses, traced and filtered, against
// OpenImageIO's st_warp of the same plate by our map, which it does not have to trace. Both on as many
// threads as the machine has.

#include <OpenImageIO/imagebufalgo.h>
#include <benchmark/benchmark.h>

#include <cmath>

#include "pipeline/composite/compositor.h"
#include "src/constants.h"
#include "src/lens_map.h"
#include "tests/benchmarks/benchmark_scenes.h"

namespace lensplane {
namespace {

constexpr int kWidth = 3840, kHeight = 2160;

const Picture& plate() {
  static const Picture made = [] {
    Picture picture{kWidth, kHeight, 0, 0, kWidth, kHeight, {}};
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const auto wave = [&](double length) {
          return static_cast<float>(0.5 + 0.5 * std::sin((column + 0.3 * row) / length));
        };
        picture.pixels.push_back({wave(3), wave(17), wave(90), 1});
      }
    }
    return picture;
  }();
  return made;
}

Tracer tracer_of(const Scene& scene) {
  TraceSettings settings;
  settings.effects.jacobian = true;
  return Tracer(scene, plan_trace(scene, settings));
}

void trace_and_filter(benchmark::State& state) {
  const Scene scene = fig6(kWidth, kHeight);
  const Tracer tracer = tracer_of(scene);
  const SurfaceLook look{std::make_shared<const Texture>(plate(), Wrap::Black), {}, {}, {}};
  const Sampling sampling{static_cast<int>(state.range(0))};
  for (auto _ : state) {
    const Composite result = composite(tracer, {look}, sampling);
    state.counters["refined"] = static_cast<double>(result.refined);
    benchmark::DoNotOptimize(result.picture.pixels.data());
  }
}

void st_warp(benchmark::State& state) {
  const Scene scene = fig6(kWidth, kHeight);
  const LensMap map = trace_maps(Tracer(scene, plan_trace(scene, TraceSettings{}))).front();
  OIIO::ImageBuf source(OIIO::ImageSpec(kWidth, kHeight, 4, OIIO::TypeDesc::FLOAT));
  source.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, plate().pixels.data());
  OIIO::ImageBuf st(OIIO::ImageSpec(kWidth, kHeight, 2, OIIO::TypeDesc::FLOAT));
  std::size_t i = 0;
  for (OIIO::ImageBuf::Iterator<float> pixel(st); !pixel.done(); ++pixel, ++i) {
    pixel[0] = map.s[i];
    pixel[1] = 1 - map.t[i];
  }
  for (auto _ : state) benchmark::DoNotOptimize(OIIO::ImageBufAlgo::st_warp(source, st));
}

BENCHMARK(trace_and_filter)->Unit(benchmark::kMillisecond)->UseRealTime()->Arg(64)->Arg(1);
BENCHMARK(st_warp)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lensplane
