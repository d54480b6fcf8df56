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

namespace lensplane {
namespace {

constexpr int kWidth = 3840, kHeight = 2160;

/// The paper's Fig. 6 before a plate: three sources at three depths, not in a line.
Scene three_sources() {
  Scene scene;
  scene.camera.width = kWidth;
  scene.camera.height = kHeight;
  scene.camera.fov_rad = 3.0 * kPi / 180.0;
  const double m = geometric_mass_from_kg(1.989e31);
  const double side = 5.95e6;
  scene.lenses = {{m, {-side, -0.5 * side, -0.4 * 1.09e9}},
                  {m, {side, -0.4 * side, -0.5 * 1.09e9}},
                  {m, {0.1 * side, 0.9 * side, -0.6 * 1.09e9}}};
  scene.surfaces = {Plate{}};
  return scene;
}

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
  const Scene scene = three_sources();
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
  const Scene scene = three_sources();
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
