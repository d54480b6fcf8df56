// SPDX-License-Identifier: Apache-2.0
//
// The mesh of bent rays that POV-Ray is given, for an HD frame behind two masses: tracing its rays, and
// writing its text, of `bytes`.

#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>

#include "pipeline/povray/ray_mesh.h"
#include "src/outgoing_rays.h"

namespace lensplane {
namespace {

Scene hd_scene() {
  Scene scene;
  scene.camera.width = 1920;
  scene.camera.height = 1080;
  scene.camera.fov_rad = 0.7;
  scene.lenses = {{0.03, {-1, 1, -50}}, {0.015, {2, 0, -60}}};
  scene.surfaces = {LatLong{}};
  return scene;
}

std::vector<FilmPosition> films_of(const Camera& camera) {
  std::vector<FilmPosition> films;
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) films.push_back({column + 0.5, row + 0.5});
  }
  return films;
}

void outgoing_rays_hd(benchmark::State& state) {
  const Scene scene = hd_scene();
  const Plan plan = plan_trace(scene, Method::Planes);
  const auto films = films_of(scene.camera);
  for (auto _ : state) benchmark::DoNotOptimize(outgoing_rays(scene, plan, films));
}
BENCHMARK(outgoing_rays_hd)->Unit(benchmark::kMillisecond)->UseRealTime();

void ray_mesh_hd(benchmark::State& state) {
  const Scene scene = hd_scene();
  const auto rays = outgoing_rays(scene, plan_trace(scene, Method::Planes), films_of(scene.camera));
  const auto path = std::filesystem::temp_directory_path() / "ray_mesh_benchmark.inc";
  for (auto _ : state) {
    std::ofstream file(path, std::ios::binary);
    write_ray_mesh(scene.camera, rays, 1.0, file);
  }
  state.counters["bytes"] = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::remove(path);
}
BENCHMARK(ray_mesh_hd)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lensplane
