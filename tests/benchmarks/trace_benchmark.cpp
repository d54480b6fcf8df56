// SPDX-License-Identifier: Apache-2.0
//
// How fast light is traced: from film positions to (s, t), one thread, double precision, a 3840 x 2160 frame.
//
// `items_per_second` is rays per second and core. The scalar march() is the same work without batches.

#include <benchmark/benchmark.h>

#include "src/constants.h"
#include "src/march.h"
#include "src/tracer.h"

namespace lensplane {
namespace {

/// The paper's Fig. 6: three sources at three depths, not in a line; a plate at infinity behind them, or the
/// Earth.
Scene three_sources(const Surface& surface) {
  Scene scene;
  scene.camera.width = 3840;
  scene.camera.height = 2160;
  scene.camera.fov_rad = 3.0 * kPi / 180.0;
  const double m = geometric_mass_from_kg(1.989e31);
  const double side = 5.95e6;
  scene.lenses = {{m, {-side, -0.5 * side, -0.4 * 1.09e9}},
                  {m, {side, -0.4 * side, -0.5 * 1.09e9}},
                  {m, {0.1 * side, 0.9 * side, -0.6 * 1.09e9}}};
  scene.surfaces = {surface};
  return scene;
}

void trace_frame(benchmark::State& state, const Scene& scene, Method method) {
  const Tracer tracer(scene, plan_trace(scene, method));
  TraceBatch batch = tracer.make_batch();
  std::int64_t rays = 0;
  for (auto _ : state) {
    for (int row = 0; row < scene.camera.height; ++row) {
      for (int column = 0; column < scene.camera.width; column += kBatchSize) {
        for (int i = 0; i < kBatchSize; ++i) {
          batch.x[i] = column + i + 0.5;
          batch.y[i] = row + 0.5;
        }
        tracer.trace(batch);
        benchmark::DoNotOptimize(batch.surfaces.front().s);
        rays += kBatchSize;
      }
    }
  }
  state.SetItemsProcessed(rays);
}

void plate_by_shinotsuka_makino(benchmark::State& state) {
  trace_frame(state, three_sources(Plate{}), Method::ShinotsukaMakino);
}

void plate_by_kishi(benchmark::State& state) {
  trace_frame(state, three_sources(Plate{}), Method::Kishi);
}

void sphere_by_shinotsuka_makino(benchmark::State& state) {
  trace_frame(state, three_sources(Sphere{{0, 0, -1.09e9}, 6.371e6, {}}), Method::ShinotsukaMakino);
}

void sky_by_shinotsuka_makino(benchmark::State& state) {
  trace_frame(state, three_sources(LatLong{}), Method::ShinotsukaMakino);
}

/// The readable reference, a ray at a time; every 16th ray of every 16th row.
void plate_by_scalar_march(benchmark::State& state) {
  const Scene scene = three_sources(Plate{});
  const Plan plan = plan_trace(scene, Method::ShinotsukaMakino);
  std::int64_t rays = 0;
  for (auto _ : state) {
    for (int row = 0; row < scene.camera.height; row += 16) {
      for (int column = 0; column < scene.camera.width; column += 16) {
        const FilmPosition film{column + 0.5, row + 0.5};
        const RayPath<double> path = march(plan.planes, Vec3(0), direction_from_pixel(scene.camera, film));
        benchmark::DoNotOptimize(meet(scene.surfaces.front(), scene.camera, film, path));
        ++rays;
      }
    }
  }
  state.SetItemsProcessed(rays);
}

BENCHMARK(plate_by_shinotsuka_makino)->Unit(benchmark::kMillisecond);
BENCHMARK(plate_by_kishi)->Unit(benchmark::kMillisecond);
BENCHMARK(sphere_by_shinotsuka_makino)->Unit(benchmark::kMillisecond);
BENCHMARK(sky_by_shinotsuka_makino)->Unit(benchmark::kMillisecond);
BENCHMARK(plate_by_scalar_march)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lensplane
