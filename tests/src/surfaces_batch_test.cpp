// SPDX-License-Identifier: Apache-2.0

#include "src/surfaces_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "src/bodies.h"
#include "tests/src/film.h"

namespace lensplane {
namespace {

TEST(SurfacesBatch, EntersSpheresWhereTheReferenceDoes) {
  const Camera camera = test_camera(1.0);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> position(-10, 10), radius(0.01, 12);
  int hits = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 centre(position(random), position(random), position(random) - 8);
    const double r = radius(random);
    const double end_distance = trial % 2 ? 10.0 : std::numeric_limits<double>::infinity();
    Film film;
    random_film(random, camera, film);
    const auto rays = std::make_unique<LineBatch<double>>();
    start_lines(camera, slope_per_pixel(camera), film.x, film.y, true, *rays);
    Ends ends;
    end_at_plane(end_distance, *rays, ends);
    alignas(64) BatchArray entry;
    enter_sphere<double>({centre, r, {}}, rays->start, rays->direction, ends, entry);
    for (int i = 0; i < kBatchSize; ++i) {
      const Vec3 direction = direction_from_pixel(camera, {film.x[i], film.y[i]});
      const double expected = sphere_entry(Vec3(0), direction, centre, r);
      if (std::isfinite(expected) && expected <= end_distance / -direction.z) {
        EXPECT_NEAR(entry[i], expected, 1e-12);
        ++hits;
      } else {
        EXPECT_TRUE(std::isinf(entry[i]));
      }
    }
  }
  EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace lensplane
