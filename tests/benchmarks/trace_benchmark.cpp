// SPDX-License-Identifier: Apache-2.0
//
// How fast light is traced: from film positions to (s, t), one thread, double precision, a 3840 x 2160 frame.
//
// `items_per_second` is rays per second and core. Three sources on three planes and a plate at infinity,
// unless the name says otherwise; by `planes` with the weak law and without finite distance, unless it says
// otherwise. bare_loop is what `weak` has to do, written by hand for it alone, without any checks: what
// effects and outcomes that nobody asked for cost is the difference between the two.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "src/constants.h"
#include "src/lens_map.h"
#include "src/march.h"
#include "src/planes_march.h"
#include "src/rotation.h"
#include "src/tracer.h"
#include "tests/benchmarks/benchmark_scenes.h"

namespace lensplane {
namespace {

constexpr int kRowLength = 64;

/// The paper's Fig. 6.
Scene three_sources(const Surface& surface = Plate{}) {
  return fig6(3840, 2160, surface);
}

/// `count` sources on `planes` planes, all over the frame, together as heavy as the three.
Scene many_sources(int count, int planes) {
  Scene scene = three_sources();
  const double m = 3.0 * scene.lenses.front().m / count;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-1.2e7, 1.2e7), y(-7e6, 7e6);
  scene.lenses.clear();
  for (int i = 0; i < count; ++i) {
    const double depth = 1.09e9 * (0.3 + 0.4 * (i % planes) / planes);
    scene.lenses.push_back({m, {x(random), y(random), -depth}});
  }
  return scene;
}

TraceSettings told(Law law, Effects effects = {}) {
  return {Method::Planes, law, 0.05, Choice::Off, effects};
}

TraceSettings by(Method method) {
  TraceSettings settings;
  settings.method = method;
  return settings;
}

/// A batch of pixel centres, kRowLength to the row.
void place_rays(int left, int top, TraceBatch& batch) {
  for (int row = 0; row < kBatchSize / kRowLength; ++row) {
    for (int k = 0; k < kRowLength; ++k) {
      batch.x[row * kRowLength + k] = left + k + 0.5;
      batch.y[row * kRowLength + k] = top + row + 0.5;
    }
  }
}

/// Traces every `sparse`th batch of the frame, by tiles as maps are.
void trace_frame(benchmark::State& state, const Scene& scene, const TraceSettings& settings, int sparse = 1) {
  const Tracer tracer(scene, plan_trace(scene, settings));
  TraceBatch batch = tracer.make_batch();
  std::int64_t rays = 0;
  const int width = kRowLength, height = kBatchSize / width;
  for (auto _ : state) {
    for (int top = 0; top < scene.camera.height; top += height * sparse) {
      for (int left = 0; left < scene.camera.width; left += width) {
        place_rays(left, top, batch);
        tracer.trace(batch);
        benchmark::DoNotOptimize(batch.surfaces.front().s);
        rays += kBatchSize;
      }
    }
  }
  state.SetItemsProcessed(rays);
}

// Laws and effects.
void weak(benchmark::State& state) {
  trace_frame(state, three_sources(), told(Law::Weak));
}
void second_order(benchmark::State& state) {
  trace_frame(state, three_sources(), told(Law::SecondOrder));
}
void exact(benchmark::State& state) {
  trace_frame(state, three_sources(), told(Law::Exact));
}
void weak_with_finite_distance(benchmark::State& state) {
  TraceSettings settings = told(Law::Weak);
  settings.finite_distance = Choice::On;
  trace_frame(state, three_sources(), settings);
}
void exact_with_finite_distance(benchmark::State& state) {
  TraceSettings settings = told(Law::Exact);
  settings.finite_distance = Choice::On;
  trace_frame(state, three_sources(), settings);
}
void by_the_plan(benchmark::State& state) {
  trace_frame(state, three_sources(), TraceSettings{});
}
void weak_with_jacobian_and_magnification(benchmark::State& state) {
  trace_frame(state, three_sources(), told(Law::Weak, {.jacobian = true, .magnification = true}));
}
void exact_with_jacobian_and_magnification(benchmark::State& state) {
  trace_frame(state, three_sources(), told(Law::Exact, {.jacobian = true, .magnification = true}));
}
void weak_with_delay(benchmark::State& state) {
  trace_frame(state, three_sources(), told(Law::Weak, {.delay = true}));
}
void weak_with_direction(benchmark::State& state) {
  trace_frame(state, three_sources(), told(Law::Weak, {.direction = true}));
}
void weak_with_shadow_bends_and_depth(benchmark::State& state) {
  trace_frame(state, three_sources(), told(Law::Weak, {.shadow = true, .bends = true, .depth = true}));
}

// Surfaces and projections.
void weak_sphere(benchmark::State& state) {
  trace_frame(state, three_sources(Sphere{{0, 0, -1.09e9}, 6.371e6, {}}), told(Law::Weak), 4);
}
void weak_sky(benchmark::State& state) {
  trace_frame(state, three_sources(LatLong{}), told(Law::Weak), 4);
}
void exact_panorama(benchmark::State& state) {
  Scene scene = three_sources(LatLong{});
  scene.camera.projection = Projection::LatLong;
  trace_frame(state, scene, told(Law::Exact), 8);
}
void exact_shadow_filling_the_frame(benchmark::State& state) {
  Scene scene = three_sources(LatLong{});
  scene.lenses.resize(1);
  scene.lenses[0].position = {0, 0, -6e6};  // 400 m away
  trace_frame(state, scene, told(Law::Exact), 4);
}

// Methods.
void shinotsuka_makino(benchmark::State& state) {
  trace_frame(state, three_sources(), by(Method::ShinotsukaMakino));
}
void kishi(benchmark::State& state) {
  trace_frame(state, three_sources(), by(Method::Kishi));
}
void geodesic_to_1em9(benchmark::State& state) {
  const Scene scene = three_sources();
  TraceSettings settings = by(Method::Geodesic);
  settings.tolerance_px = 1e-9 / kGeodesicShare / pixel_angle(scene.camera);
  trace_frame(state, scene, settings, 90);
}

// Numbers of sources.
void hundred_sources_on_ten_planes(benchmark::State& state) {
  trace_frame(state, many_sources(100, 10), told(Law::Weak), 16);
}
void sources_on_ten_planes(benchmark::State& state) {
  const auto count = static_cast<int>(state.range(0));
  trace_frame(state, many_sources(count, 10), told(Law::Weak), count < 100 ? 4 : count < 1000 ? 32 : 256);
}

// Whole maps band by band, as the program writes them, by frame width and by threads; the seconds are real
// ones.
void map_of_width(benchmark::State& state) {
  Scene scene = three_sources();
  scene.camera.width = static_cast<int>(state.range(0));
  scene.camera.height = scene.camera.width * 9 / 16;
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(1)));
  const Tracer tracer(scene, plan_trace(scene, told(Law::Weak)));
  std::vector<LensMap> maps;
  for (auto _ : state) {
    for (int row = 0; row < scene.camera.height; row += 256) {
      maps = trace_maps(tracer, {row, std::min(row + 256, scene.camera.height)}, std::move(maps));
      benchmark::DoNotOptimize(maps.front().s.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * scene.camera.width * scene.camera.height);
}

/// The readable reference, a ray at a time; every 16th ray of every 16th row.
void scalar_reference(benchmark::State& state) {
  const Scene scene = three_sources();
  const Deflectors deflectors = deflectors_of(scene, Law::Weak, false);
  std::int64_t rays = 0;
  for (auto _ : state) {
    for (int row = 0; row < scene.camera.height; row += 16) {
      for (int column = 0; column < scene.camera.width; column += 16) {
        const FilmPosition film{column + 0.5, row + 0.5};
        const auto path = march_planes(deflectors, direction_from_film<double>(scene.camera, film));
        benchmark::DoNotOptimize(meet(scene.surfaces.front(), scene.camera, film, path));
        ++rays;
      }
    }
  }
  state.SetItemsProcessed(rays);
}

struct BareRays {
  alignas(64) BatchArray film_x, film_y, x, y, z, dx, dy, dz, ax, ay, az, per_b2, s, t;
};

LENSPLANE_KERNEL void bare_start(const Camera& camera, double slope, BareRays& r) {
  const double cx = camera.width / 2.0, cy = camera.height / 2.0;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double right = (r.film_x[i] - cx) * slope, up = (cy - r.film_y[i]) * slope;
    const double scale = 1.0 / std::sqrt(right * right + up * up + 1.0);
    r.x[i] = r.y[i] = r.z[i] = 0.0;
    r.dx[i] = right * scale, r.dy[i] = up * scale, r.dz[i] = -scale;
  }
}

LENSPLANE_KERNEL void bare_bend(const Lens& lens, BareRays& r) {
  const double m4 = 4.0 * lens.m;
  const Vec3 p = lens.position;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double tx = p.x - r.x[i], ty = p.y - r.y[i], tz = p.z - r.z[i];
    const double along = tx * r.dx[i] + ty * r.dy[i] + tz * r.dz[i];
    r.ax[i] = tx - along * r.dx[i], r.ay[i] = ty - along * r.dy[i], r.az[i] = tz - along * r.dz[i];
    r.per_b2[i] = 1.0 / (r.ax[i] * r.ax[i] + r.ay[i] * r.ay[i] + r.az[i] * r.az[i]);
  }
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double k = m4 * r.per_b2[i], q = m4 * k;
    const Turn<double> turn = short_turn(q);
    const double back = m4 * turn.sine, aside = k * turn.sine, c = turn.cosine;
    r.x[i] = p.x - (r.ax[i] * c - r.dx[i] * back);
    r.y[i] = p.y - (r.ay[i] * c - r.dy[i] * back);
    r.z[i] = p.z - (r.az[i] * c - r.dz[i] * back);
    r.dx[i] = r.dx[i] * c + r.ax[i] * aside;
    r.dy[i] = r.dy[i] * c + r.ay[i] * aside;
    r.dz[i] = r.dz[i] * c + r.az[i] * aside;
  }
}

LENSPLANE_KERNEL void bare_plate(const Camera& camera, double slope, BareRays& r) {
  const double to_s = 1.0 / (slope * camera.width), to_t = 1.0 / (slope * camera.height);
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double per_depth = -1.0 / r.dz[i];
    r.s[i] = 0.5 + r.dx[i] * per_depth * to_s;
    r.t[i] = 0.5 + r.dy[i] * per_depth * to_t;
  }
}

void bare_loop(benchmark::State& state) {
  const Scene scene = three_sources();
  static BareRays rays;
  const double slope = slope_per_pixel(scene.camera);
  std::int64_t count = 0;
  for (auto _ : state) {
    for (int row = 0; row < scene.camera.height; ++row) {
      for (int column = 0; column < scene.camera.width; column += kBatchSize) {
        for (int i = 0; i < kBatchSize; ++i) {
          rays.film_x[i] = column + i + 0.5, rays.film_y[i] = row + 0.5;
        }
        bare_start(scene.camera, slope, rays);
        for (const Lens& lens : scene.lenses) bare_bend(lens, rays);
        bare_plate(scene.camera, slope, rays);
        benchmark::DoNotOptimize(rays.s);
        count += kBatchSize;
      }
    }
  }
  state.SetItemsProcessed(count);
}

BENCHMARK(bare_loop)->Unit(benchmark::kMillisecond);
BENCHMARK(weak)->Unit(benchmark::kMillisecond);
BENCHMARK(second_order)->Unit(benchmark::kMillisecond);
BENCHMARK(exact)->Unit(benchmark::kMillisecond);
BENCHMARK(weak_with_jacobian_and_magnification)->Unit(benchmark::kMillisecond);
BENCHMARK(exact_with_jacobian_and_magnification)->Unit(benchmark::kMillisecond);
BENCHMARK(weak_with_finite_distance)->Unit(benchmark::kMillisecond);
BENCHMARK(exact_with_finite_distance)->Unit(benchmark::kMillisecond);
BENCHMARK(by_the_plan)->Unit(benchmark::kMillisecond);
BENCHMARK(weak_with_delay)->Unit(benchmark::kMillisecond);
BENCHMARK(weak_with_direction)->Unit(benchmark::kMillisecond);
BENCHMARK(weak_with_shadow_bends_and_depth)->Unit(benchmark::kMillisecond);
BENCHMARK(weak_sphere)->Unit(benchmark::kMillisecond);
BENCHMARK(weak_sky)->Unit(benchmark::kMillisecond);
BENCHMARK(exact_panorama)->Unit(benchmark::kMillisecond);
BENCHMARK(exact_shadow_filling_the_frame)->Unit(benchmark::kMillisecond);
BENCHMARK(shinotsuka_makino)->Unit(benchmark::kMillisecond);
BENCHMARK(kishi)->Unit(benchmark::kMillisecond);
BENCHMARK(geodesic_to_1em9)->Unit(benchmark::kMillisecond);
BENCHMARK(hundred_sources_on_ten_planes)->Unit(benchmark::kMillisecond);
BENCHMARK(sources_on_ten_planes)->Unit(benchmark::kMillisecond)->RangeMultiplier(10)->Range(1, 10000);
BENCHMARK(map_of_width)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->ArgsProduct({{480, 960, 1920, 3840, 7680, 15360}, {1}})
    ->Args({3840, 2});
BENCHMARK(scalar_reference)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lensplane
