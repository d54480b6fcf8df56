// SPDX-License-Identifier: Apache-2.0

#include "src/film_cell.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/src/scenes.h"

namespace lensplane {
namespace {

/// A film of 1000 x 1000 pixels and a mass in its middle with an Einstein radius of 100 pixels.
Scene point_lens() {
  const double distance = 1e9, einstein = 1e-5;
  Scene scene;
  scene.camera.width = scene.camera.height = 1000;
  scene.camera.fov_rad = 10 * einstein;
  scene.lenses = {{einstein * einstein * distance / 4, {0, 0, -distance}}};
  return scene;
}

SkyRays sky_rays() {
  const Scene scene = point_lens();
  return SkyRays(
      Tracer(scene, plan_trace(scene, TraceSettings{Method::Planes, Law::Weak, 0.05, Choice::Off, {}})));
}

FilmCell cell_at(const SkyRays& rays, double x, double y, double size) {
  return trace_cells(rays, {x, y}, size, 1, 1).front();
}

TEST(FilmCell, IsRegularAwayFromMassesAndCriticalCurves) {
  const SkyRays rays = sky_rays();
  EXPECT_TRUE(view_of(cell_at(rays, 800, 500, 8)).regular);
  EXPECT_TRUE(view_of(cell_at(rays, 560, 500, 1)).regular);   // mirrored
  EXPECT_FALSE(view_of(cell_at(rays, 596, 496, 8)).regular);  // on the Einstein ring
  EXPECT_FALSE(view_of(cell_at(rays, 596, 496, 8)).wild);
  EXPECT_TRUE(view_of(cell_at(rays, 504, 500, 8)).wild);  // beside the mass
  EXPECT_LT(view_of(cell_at(rays, 504, 500, 8)).largest_magnification, 1e-2);
}

TEST(FilmCell, MapIsRightToTheSquareOfTheBend) {
  const SkyRays rays = sky_rays();
  for (const double x : {560.0, 640.0, 700.0, 900.0}) {
    const FilmCell cell = cell_at(rays, x, 530, 4);
    const CellView view = view_of(cell);
    ASSERT_TRUE(view.regular);
    const FilmPosition film{x + 0.7, 533.1};
    const SkyRay seen = rays.trace(std::vector<FilmPosition>{film}).front();
    const FilmPosition found = map_of(cell).film_of(seen.direction);
    EXPECT_LT(std::hypot(found.x - film.x, found.y - film.y), cell.size * view.bend * view.bend + 1e-9) << x;
    EXPECT_TRUE(grown(view.patch, 1 + view.bend, view.bend / 2).contains(seen.direction)) << x;
  }
}

TEST(FilmCell, QuartersAreItsOwnRaysAndOnesBetweenThem) {
  const SkyRays rays = sky_rays();
  const auto cells = trace_cells(rays, {100, 200}, 8, 3, 2);
  ASSERT_EQ(cells.size(), 6U);
  EXPECT_EQ(cells[4].corners[0].film.x, 108);
  EXPECT_EQ(cells[4].corners[3].film.y, 216);
  EXPECT_EQ(cells[4].centre.film.y, 212);
  const auto quarters = trace_quarters(rays, cells);
  ASSERT_EQ(quarters.size(), 24U);
  for (std::size_t k = 0; k < quarters.size(); ++k) {
    const FilmCell& quarter = quarters[k];
    EXPECT_EQ(quarter.size, 4);
    const FilmPosition corner = cells[k / 4].corners[0].film;
    const FilmCell again = cell_at(rays, corner.x + 4 * double(k % 2), corner.y + 4 * double(k % 4 / 2), 4);
    EXPECT_EQ(quarter.centre.direction, again.centre.direction);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(quarter.corners[i].direction, again.corners[i].direction);
  }
}

}  // namespace
}  // namespace lensplane
