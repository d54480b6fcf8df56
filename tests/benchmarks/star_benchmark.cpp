// SPDX-License-Identifier: Apache-2.0
//
// What stars cost: finding all images of 41 411 stars in an HD frame behind three masses and drawing them,
// against tracing that frame with the Jacobian twice. All on as many threads as the machine has; with
// `taskset -c 0` on one.

#include <benchmark/benchmark.h>

#include <random>

#include "pipeline/composite/star_drawing.h"
#include "src/constants.h"
#include "src/lens_map.h"
#include "tests/benchmarks/benchmark_scenes.h"

namespace lensplane {
namespace {

constexpr int kStars = 41411;

/// The paper's Fig. 6 in HD.
Scene three_sources(const Surface& surface = Plate{}) {
  return fig6(1920, 1080, surface);
}

Tracer tracer_of(const Scene& scene, Effects effects = {}) {
  TraceSettings settings;
  settings.effects = effects;
  return Tracer(scene, plan_trace(scene, settings));
}

/// Stars all over the frame.
StarField stars_in_frame(const Scene& scene, int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(0, scene.camera.width), y(0, scene.camera.height), v(2, 8);
  std::vector<Star> stars;
  for (int i = 0; i < count; ++i) {
    stars.push_back({direction_from_pixel(scene.camera, {x(random), y(random)}), v(random), 0.6});
  }
  return star_field(stars);
}

Picture black(const Camera& camera) {
  Picture picture{camera.width, camera.height, 0, 0, camera.width, camera.height, {}};
  picture.pixels.assign(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height), {});
  return picture;
}

void find(benchmark::State& state, const Scene& scene) {
  const Tracer tracer = tracer_of(scene);
  const StarField field = stars_in_frame(scene, static_cast<int>(state.range(0)));
  std::size_t images = 0;
  for (auto _ : state) images = find_star_images(tracer, field).size();
  state.counters["images"] = static_cast<double>(images);
}

void find_behind_three_masses(benchmark::State& state) {
  find(state, three_sources());
}
void find_without_masses(benchmark::State& state) {
  Scene scene = three_sources();
  scene.lenses.clear();
  find(state, scene);
}

void find_and_draw_behind_three_masses(benchmark::State& state) {
  const Scene scene = three_sources();
  const Tracer tracer = tracer_of(scene);
  const StarField field = stars_in_frame(scene, kStars);
  Picture picture = black(scene.camera);
  for (auto _ : state) draw_stars(find_star_images(tracer, field), {}, tracer.camera(), picture);
}

void draw(benchmark::State& state) {
  const Scene scene = three_sources();
  const std::vector<StarImage> images = find_star_images(tracer_of(scene), stars_in_frame(scene, kStars));
  Picture picture = black(scene.camera);
  for (auto _ : state) draw_stars(images, {}, scene.camera, picture);
  state.counters["images"] = static_cast<double>(images.size());
}

void trace_with_jacobian_twice(benchmark::State& state, const Surface& surface) {
  const Scene scene = three_sources(surface);
  const Tracer tracer = tracer_of(scene, {.jacobian = true});
  for (auto _ : state) {
    for (int i = 0; i < 2; ++i) benchmark::DoNotOptimize(trace_maps(tracer));
  }
}
void trace_plate_with_jacobian_twice(benchmark::State& state) {
  trace_with_jacobian_twice(state, Plate{});
}
void trace_sky_with_jacobian_twice(benchmark::State& state) {
  trace_with_jacobian_twice(state, LatLong{});
}

BENCHMARK(trace_plate_with_jacobian_twice)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(trace_sky_with_jacobian_twice)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(find_and_draw_behind_three_masses)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(find_behind_three_masses)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Arg(100)
    ->Arg(4000)
    ->Arg(kStars);
BENCHMARK(find_without_masses)->Unit(benchmark::kMillisecond)->UseRealTime()->Arg(kStars);
BENCHMARK(draw)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lensplane
