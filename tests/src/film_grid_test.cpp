// SPDX-License-Identifier: Apache-2.0

#include "src/film_grid.h"

#include <gtest/gtest.h>

#include "tests/src/film.h"

namespace lensplane {
namespace {

TEST(FilmGrid, IsTheFinestThatHasNoMorePixels) {
  const Camera camera = test_camera(0.5);  // 1920 x 1080
  const FilmGrid grid = grid_of(camera, 40000);
  EXPECT_EQ(grid.step, 8);
  EXPECT_EQ(grid.columns, 240);
  EXPECT_EQ(grid.rows, 135);
  EXPECT_EQ(grid_of(camera, 1920 * 1080).step, 1);
  EXPECT_EQ(grid_of(camera, 1920 * 1080 - 1).step, 2);
  EXPECT_GE(grid_of(camera, 0).count(), 1);
}

TEST(FilmGrid, LiesInTheFrameOnPixelCentres) {
  Camera camera = test_camera(0.5);
  for (const auto& [width, height] : {std::pair{7, 3}, {1000, 1}, {33, 64}, {1, 1}}) {
    camera.width = width;
    camera.height = height;
    for (const int most : {1, 5, 50, 5000}) {
      const FilmGrid grid = grid_of(camera, most);
      ASSERT_LE(grid.count(), most);
      for (int i = 0; i < grid.count(); ++i) {
        const FilmPosition film = grid.at(i);
        ASSERT_TRUE(film.x > 0 && film.x < width && film.y > 0 && film.y < height);
        ASSERT_EQ(film.x - 0.5, static_cast<int>(film.x));
      }
    }
  }
}

TEST(FilmGrid, IsTracedPixelByPixel) {
  Scene scene;
  scene.camera = test_camera(0.2);
  scene.lenses = {{1e3, {1e4, 3e4, -1e6}}};
  scene.surfaces = {Plate{}};
  const Tracer tracer(scene, plan_trace(scene, TraceSettings{}));
  const FilmGrid grid = grid_of(scene.camera, 300);
  const auto batches = trace_grid(tracer, grid);
  ASSERT_EQ(batches.size(), static_cast<std::size_t>((grid.count() + kBatchSize - 1) / kBatchSize));
  TraceBatch single = tracer.make_batch();
  for (int n = 0; n < grid.count(); ++n) {
    for (int i = 0; i < kBatchSize; ++i) single.x[i] = grid.at(n).x, single.y[i] = grid.at(n).y;
    tracer.trace(single);
    EXPECT_EQ(batches[static_cast<std::size_t>(n / kBatchSize)].surfaces[0].s[n % kBatchSize],
              single.surfaces[0].s[0]);
  }
}

}  // namespace
}  // namespace lensplane
