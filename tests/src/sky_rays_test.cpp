// SPDX-License-Identifier: Apache-2.0

#include "src/sky_rays.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/src/scenes.h"

namespace lensplane {
namespace {

Scene hole_scene(Projection projection) {
  Scene scene;
  scene.camera.width = 200;
  scene.camera.height = 100;
  scene.camera.projection = projection;
  scene.camera.fov_rad = 1.0;
  scene.camera.axes = basis_from_zxy({1.3, 0.4, 0.2});  // near the world's pole
  scene.lenses = {{1.0, scene.camera.axes.parent_from_local({2, 1, -60})}};
  return scene;
}

TEST(SkyRays, DerivativesAreThoseOfTheDirections) {
  const double h = 1e-4;
  for (const Projection projection : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    const Scene scene = hole_scene(projection);
    const SkyRays rays(Tracer(scene, plan_trace(scene, TraceSettings{})));
    for (const FilmPosition film : {FilmPosition{70, 40}, {130, 60}, {125, 25}, {80, 20}}) {
      const std::vector<FilmPosition> films = {
          film, {film.x - h, film.y}, {film.x + h, film.y}, {film.x, film.y - h}, {film.x, film.y + h}};
      const std::vector<SkyRay> seen = rays.trace(films);
      const SkyRay& ray = seen[0];
      ASSERT_TRUE(ray.seen);
      EXPECT_NEAR(ray.direction.length(), 1, 1e-14);
      const double scale = ray.by_x.length() + ray.by_y.length();
      EXPECT_LT((ray.by_x - (seen[2].direction - seen[1].direction) / (2 * h)).length(), 1e-6 * scale);
      EXPECT_LT((ray.by_y - (seen[4].direction - seen[3].direction) / (2 * h)).length(), 1e-6 * scale);
      EXPECT_NE(ray.magnification, 0);
    }
  }
}

TEST(SkyRays, SeeThroughSurfacesAndNotThroughMasses) {
  Scene scene = hole_scene(Projection::Perspective);
  scene.surfaces = {Sphere{scene.camera.axes.parent_from_local({0, 0, -5}), 4, {}}};
  const SkyRays rays(Tracer(scene, plan_trace(scene, TraceSettings{})));
  const FilmPosition shadow = pixel_from_slopes(scene.camera, {2.0 / 60, 1.0 / 60});
  const std::vector<SkyRay> seen = rays.trace(std::vector<FilmPosition>{{10, 10}, {100, 70}, shadow});
  EXPECT_TRUE(seen[0].seen);
  EXPECT_TRUE(seen[1].seen);
  EXPECT_FALSE(seen[2].seen);
  EXPECT_EQ(seen[1].film.y, 70);
}

TEST(SkyRays, HaveNoStepsBetweenTheTilesOfAPlan) {
  Scene scene = hole_scene(Projection::Perspective);
  scene.camera.width = 400;
  scene.camera.height = 256;
  TraceSettings settings;
  settings.tolerance_px = 1;
  const Plan plan = plan_trace(scene, settings);
  const auto& levels = plan.tiles.level;
  ASSERT_NE(*std::min_element(levels.begin(), levels.end()), *std::max_element(levels.begin(), levels.end()));
  const SkyRays rays(Tracer(scene, plan));
  std::vector<FilmPosition> films;
  const double close = 1e-9;
  for (int y = 1; y < 256; y += 5) {
    for (int x = 64; x < 400; x += 64)
      films.insert(films.end(), {{x - close, y + 0.5}, {x + close, y + 0.5}});
  }
  const std::vector<SkyRay> seen = rays.trace(films);
  for (std::size_t i = 0; i < seen.size(); i += 2) {
    if (!seen[i].seen || !seen[i + 1].seen) continue;
    const double expected = 2 * close * seen[i].by_x.length();
    EXPECT_LT((seen[i].direction - seen[i + 1].direction).length(), 2 * expected + 1e-14);
  }
}

}  // namespace
}  // namespace lensplane
