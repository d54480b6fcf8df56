// SPDX-License-Identifier: Apache-2.0

#include "src/projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "src/constants.h"

namespace lensplane {
namespace {

Camera camera_with(int width, int height, double fov_deg) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fov_rad = fov_deg * kPi / 180.0;
  return camera;
}

TEST(Projection, FilmCentreLooksStraightAhead) {
  const Vec3 d = direction_from_pixel(camera_with(800, 400, 60), {400, 200});
  EXPECT_EQ(d, Vec3(0, 0, -1));
}

TEST(Projection, FieldOfViewIsTheFullHorizontalAngle) {
  for (const double fov : {1e-9, 3.0, 90.0, 179.9}) {
    const Camera camera = camera_with(800, 400, fov);
    const Vec3 left = direction_from_pixel(camera, {0, 200});
    const Vec3 right = direction_from_pixel(camera, {800, 200});
    EXPECT_NEAR(std::atan2(right.x, -right.z) - std::atan2(left.x, -left.z), camera.fov_rad,
                1e-14 * camera.fov_rad);
  }
}

TEST(Projection, XIsToTheRightAndYIsDown) {
  const Camera camera = camera_with(800, 400, 60);
  EXPECT_GT(direction_from_pixel(camera, {500, 200}).x, 0);
  EXPECT_LT(direction_from_pixel(camera, {400, 300}).y, 0);
}

TEST(Projection, PixelFromSlopesUndoesSlopesFromPixel) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> position(-3000, 3000);
  for (const double fov : {1e-9, 0.5, 45.0, 120.0, 179.9}) {
    const Camera camera = camera_with(1920, 1080, fov);
    for (int i = 0; i < 1000; ++i) {
      const FilmPosition film{position(random), position(random)};
      const FilmPosition back = pixel_from_slopes(camera, slopes_from_pixel(camera, film));
      EXPECT_NEAR(back.x, film.x, 1e-11);
      EXPECT_NEAR(back.y, film.y, 1e-11);
    }
  }
}

TEST(Projection, DirectionsAreUnitVectorsAlongTheSlopes) {
  const Camera camera = camera_with(1920, 1080, 100);
  const FilmPosition film{12.25, 1033.5};
  const Vec3 d = direction_from_pixel(camera, film);
  EXPECT_NEAR(d.length(), 1.0, 1e-15);
  EXPECT_NEAR(d.x / -d.z, slopes_from_pixel(camera, film).right, 1e-15);
  EXPECT_NEAR(d.y / -d.z, slopes_from_pixel(camera, film).up, 1e-15);
}

}  // namespace
}  // namespace lensplane
