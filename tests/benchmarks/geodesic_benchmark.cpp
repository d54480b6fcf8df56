// SPDX-License-Identifier: Apache-2.0
//
// How fast curved rays are traced: three masses on the axis of a 3840 x 2160 frame of 3 degrees, one thread.
//
// `items_per_second` is rays per second and core; the argument is -log10 of the tolerance. Rays are spread
// thinly over the frame. With derivatives means with the Jacobian; one by one means without batches.

#include <benchmark/benchmark.h>

#include <cmath>

#include "src/constants.h"
#include "src/geodesic_batch.h"

namespace lensplane {
namespace {

std::vector<PointMass> three_masses() {
  const double m = geometric_mass_from_kg(1.989e31), distance = 1.09e9;
  return {{m, {0, 0, -0.4 * distance}}, {m, {0, 0, -0.5 * distance}}, {m, {0, 0, -0.6 * distance}}};
}

/// The directions of every 32nd pixel of every 32nd row, with their derivatives by the film position.
std::vector<DualVec3> film_directions() {
  constexpr int width = 3840, height = 2160, stride = 32;
  const double slope = 2.0 * std::tan(1.5 * kPi / 180.0) / width;
  std::vector<DualVec3> directions;
  for (int row = stride / 2; row < height; row += stride) {
    for (int column = stride / 2; column < width; column += stride) {
      const Dual right = slope * (Dual(column + 0.5, 1, 0) - 0.5 * width);
      const Dual up = slope * (0.5 * height - Dual(row + 0.5, 0, 1));
      const DualVec3 forward(right, up, -1.0);
      directions.push_back(times(forward, reciprocal(sqrt(forward.dot(forward)))));
    }
  }
  return directions;
}

template <class N>
std::vector<Vector<N>> directions() {
  const std::vector<DualVec3> duals = film_directions();
  if constexpr (std::is_same_v<N, Dual>) {
    return duals;
  } else {
    std::vector<Vec3> values;
    for (const DualVec3& dual : duals) values.push_back(value_of(dual));
    return values;
  }
}

template <class N>
void trace(benchmark::State& state) {
  const auto masses = three_masses();
  const auto rays = directions<N>();
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        trace_geodesics<N>(masses, Vector<N>(N(0.0)), std::span<const Vector<N>>(rays), tolerance));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

void curved_rays(benchmark::State& state) {
  trace<double>(state);
}

void curved_rays_with_derivatives(benchmark::State& state) {
  trace<Dual>(state);
}

void curved_rays_one_by_one(benchmark::State& state) {
  const auto masses = three_masses();
  const auto rays = directions<double>();
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  for (auto _ : state) {
    for (const Vec3& direction : rays) {
      benchmark::DoNotOptimize(trace_geodesic<double>(masses, Vec3(0), direction, tolerance));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

BENCHMARK(curved_rays)->Arg(6)->Arg(9)->Arg(12)->Unit(benchmark::kMillisecond);
BENCHMARK(curved_rays_with_derivatives)->Arg(6)->Arg(9)->Arg(12)->Unit(benchmark::kMillisecond);
BENCHMARK(curved_rays_one_by_one)->Arg(6)->Arg(9)->Arg(12)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lensplane
