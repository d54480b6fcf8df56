// SPDX-License-Identifier: Apache-2.0

#include "src/march_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "src/march.h"
#include "tests/src/film.h"
#include "tests/src/flat_plane.h"

namespace lensplane {
namespace {

TEST(MarchBatch, AgreesWithTheReferenceThroughRandomPlanes) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  int regular = 0;
  int irregular = 0;
  for (int scene = 0; scene < 400; ++scene) {
    const Camera camera = test_camera(std::pow(10.0, -3.0 * scene / 400.0));
    const int plane_count = 1 + scene % 5;
    std::vector<LensPlane> planes;
    for (int k = 0; k < plane_count; ++k) {
      const double depth = 10.0 * (k + 1);
      LensPlane plane = flat_plane(-depth, {});
      const double spread = depth * camera.fov_rad / 2;
      for (int s = 0; s < 3; ++s) {
        plane.sources.push_back(
            {0.01 * spread * camera.fov_rad, {spread * normal(random), spread * normal(random), -depth}});
      }
      planes.push_back(plane);
    }
    Film film;
    random_film(random, camera, film);
    const auto rays = std::make_unique<LineBatch<double>>();
    start_lines(camera, slope_per_pixel(camera), film.x, film.y, true, *rays);
    for (const LensPlane& plane : planes) {
      advance_rays(plane.distance, *rays);
      for (const Source& source : plane.sources) bend_rays(source, *rays);
    }
    for (int i = 0; i < kBatchSize; ++i) {
      const RayPath<double> path =
          march(planes, Vec3(0), direction_from_pixel(camera, {film.x[i], film.y[i]}));
      if (rays->irregular[i] != 0) {
        ++irregular;
        continue;
      }
      ++regular;
      const RaySegment<double>& last = path.segments.back();
      double travelled = 0;
      for (const RaySegment<double>& s : path.segments) travelled += std::isinf(s.length) ? 0 : s.length;
      // Each bend passes on the errors of those before it; close to a source they grow.
      const double tolerance = kBatchError * 100 * static_cast<double>(plane_count);
      EXPECT_NEAR(rays->direction.x.v[i], last.direction.x, tolerance);
      EXPECT_NEAR(rays->direction.y.v[i], last.direction.y, tolerance);
      EXPECT_NEAR(rays->direction.z.v[i], last.direction.z, tolerance);
      EXPECT_NEAR(rays->path.v[i], travelled, 1e-12 * travelled);
    }
  }
  EXPECT_GT(regular, 49000);
  EXPECT_GT(irregular, 0);
}

TEST(MarchBatch, OneBendAgreesToItsErrorBoundOverAllAngles) {
  const Camera camera = test_camera(0.5);
  std::mt19937 random(4);
  int regular = 0;
  for (double alpha = 1e-18; alpha < kBatchAlpha; alpha *= 1.7) {
    Film film;
    random_film(random, camera, film);
    const auto rays = std::make_unique<LineBatch<double>>();
    start_lines(camera, slope_per_pixel(camera), film.x, film.y, true, *rays);
    advance_rays(1, *rays);
    const Source source = source_at(-1, {alpha * 5 / 4, 3, 4});  // about b = 5 from every ray
    bend_rays(source, *rays);
    for (int i = 0; i < kBatchSize; ++i) {
      if (rays->irregular[i] != 0) continue;
      ++regular;
      const Vec3 start = direction_from_pixel(camera, {film.x[i], film.y[i]});
      const RayPath<double> path = march({{{0, 0, -1}, 1, {source}}}, Vec3(0), start);
      const Vec3 ours(rays->direction.x.v[i], rays->direction.y.v[i], rays->direction.z.v[i]);
      EXPECT_NEAR((ours - path.segments.back().direction).length(), 0, kBatchError) << alpha;
    }
  }
  EXPECT_GT(regular, 75 * kBatchSize);
}

TEST(MarchBatch, MarksWhatItCannotDo) {
  const Camera camera = test_camera(0.5);
  const auto bend_centre = [&camera](const SourceAside& source) {
    Film film;
    std::fill_n(film.x, kBatchSize, camera.width / 2.0);
    std::fill_n(film.y, kBatchSize, camera.height / 2.0);
    const auto rays = std::make_unique<LineBatch<double>>();
    start_lines(camera, slope_per_pixel(camera), film.x, film.y, true, *rays);
    advance_rays(1, *rays);
    bend_rays(source_at(-1, source), *rays);
    return rays->irregular[0] != 0;
  };
  EXPECT_FALSE(bend_centre({0.01, 1, 0}));
  EXPECT_FALSE(bend_centre({0.999 * kBatchAlpha / 4, 1, 0}));
  EXPECT_TRUE(bend_centre({1.001 * kBatchAlpha / 4, 1, 0}));  // too strong
  EXPECT_TRUE(bend_centre({1, 0, 0}));                        // exactly on the source
  EXPECT_TRUE(bend_centre({1e-300, 1e-200, 0}));              // squares underflow
  EXPECT_TRUE(bend_centre({1, 1e200, 0}));                    // squares overflow
}

}  // namespace
}  // namespace lensplane
