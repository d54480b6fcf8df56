// SPDX-License-Identifier: Apache-2.0

#include "src/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "src/constants.h"
#include "tests/src/projections.h"

namespace lensplane {
namespace {

void expect_direction(const Camera& camera, FilmPosition film, const Vec3& expected) {
  const Vec3 direction = direction_from_film<double>(camera, film);
  EXPECT_LT((direction - expected).length(), 1e-15) << direction << " at " << film.x << ", " << film.y;
}

TEST(Projection, PerspectiveLandmarks) {
  const Camera camera = camera_of(Projection::Perspective, 800, 400, 90);
  EXPECT_EQ(direction_from_film<double>(camera, {400, 200}), Vec3(0, 0, -1));
  expect_direction(camera, {800, 200}, Vec3(1, 0, -1).normalized());
  expect_direction(camera, {0, 200}, Vec3(-1, 0, -1).normalized());
  expect_direction(camera, {400, 0}, Vec3(0, 0.5, -1).normalized());
  expect_direction(camera, {400, 600}, Vec3(0, -1, -1).normalized());  // overscan
}

TEST(Projection, LatLongLandmarks) {
  const Camera camera = camera_of(Projection::LatLong, 800, 400);
  EXPECT_EQ(direction_from_film<double>(camera, {400, 200}), Vec3(0, 0, -1));
  expect_direction(camera, {600, 200}, {1, 0, 0});
  expect_direction(camera, {200, 200}, {-1, 0, 0});
  expect_direction(camera, {400, 100}, Vec3(0, 1, -1).normalized());
  for (const double x : {0.0, 123.0, 400.0, 800.0}) {
    expect_direction(camera, {x, 0}, {0, 1, 0});
    expect_direction(camera, {x, 400}, {0, -1, 0});
  }
  // Overscan goes on round the sphere, and over its poles down the other side.
  for (const double y : {17.0, 200.0, 391.5}) {
    expect_direction(camera, {0, y}, direction_from_film<double>(camera, {800, y}));
    expect_direction(camera, {-30, y}, direction_from_film<double>(camera, {770, y}));
    expect_direction(camera, {130, -y}, direction_from_film<double>(camera, {530, y}));
    expect_direction(camera, {130, 400 + y}, direction_from_film<double>(camera, {530, 400 - y}));
  }
}

TEST(Projection, FisheyeLandmarks) {
  for (const auto& [width, height] : {std::pair(800, 400), std::pair(400, 800)}) {
    const Camera camera = camera_of(Projection::Fisheye, width, height, 180);
    const double x = width / 2.0, y = height / 2.0;
    EXPECT_EQ(direction_from_film<double>(camera, {x, y}), Vec3(0, 0, -1));
    expect_direction(camera, {x + 200, y}, {1, 0, 0});
    expect_direction(camera, {x, y - 200}, {0, 1, 0});
    expect_direction(camera, {x, y + 100}, Vec3(0, -1, -1).normalized());
    expect_direction(camera, {x - 100, y}, Vec3(-1, 0, -1).normalized());
  }
  expect_direction(camera_of(Projection::Fisheye, 400, 400, 360), {200, 400}, {0, 0, 1});
}

TEST(Projection, OnlyAFisheyeHasACircle) {
  Camera camera = camera_of(Projection::Fisheye, 800, 400, 100);
  camera.overscan = 50;
  for (const double angle : {0.0, 0.3, 1.6, 2.9, 4.4}) {
    const auto at = [&](double radius) {
      return FilmPosition{400 + radius * std::cos(angle), 200 + radius * std::sin(angle)};
    };
    EXPECT_TRUE(sees(camera, at(0)));
    EXPECT_TRUE(sees(camera, at(200 * (1 - 1e-14))));
    EXPECT_FALSE(sees(camera, at(200 * (1 + 1e-14))));
    EXPECT_FALSE(sees(camera, at(230)));
  }
  EXPECT_TRUE(sees(camera, {600, 200}));
  EXPECT_FALSE(sees(camera, {std::nextafter(600, 601), 200}));
  // At the circle the direction is half the field of view from the axis.
  EXPECT_NEAR(direction_from_film<double>(camera, {600, 200}).z, -std::cos(50 * kPi / 180), 1e-15);
  for (const Projection other : {Projection::Perspective, Projection::LatLong}) {
    EXPECT_TRUE(sees(camera_of(other, 800, 400, 100), {-50, -50})) << static_cast<int>(other);
  }
}

TEST(Projection, DirectionsAreTheDefinitions) {
  std::mt19937 random(1);
  for (const Camera& camera : cameras_of_every_kind()) {
    for (int i = 0; i < 100; ++i) {
      const FilmPosition film = random_position(camera, random);
      const Vec3 direction = direction_from_film<double>(camera, film);
      const RealVec3 expected = reference_direction(camera, {film.x, film.y});
      for (int axis = 0; axis < 3; ++axis) {
        const double size = axis < 2 ? std::min(1.0, camera.width * pixel_angle(camera)) : 1.0;
        EXPECT_NEAR(direction[axis], static_cast<double>(expected[axis]), 1e-15 * size)
            << static_cast<int>(camera.projection) << " " << camera.fov_rad;
      }
      EXPECT_EQ(value_of(direction_from_film<Dual>(camera, film)), direction);
    }
  }
}

TEST(Projection, FilmFromDirectionUndoesDirectionFromFilm) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> digits(-30, 30);
  for (const Camera& camera : cameras_of_every_kind()) {
    for (int i = 0; i < 1000; ++i) {
      const FilmPosition film = random_position(camera, random);
      const Vec3 direction = direction_from_film<double>(camera, film) * std::pow(10.0, digits(random));
      const auto back = film_from_direction(camera, direction);
      ASSERT_TRUE(back) << direction;
      EXPECT_NEAR(back->x, film.x, 1e-12) << static_cast<int>(camera.projection) << " " << camera.fov_rad;
      EXPECT_NEAR(back->y, film.y, 1e-12) << static_cast<int>(camera.projection) << " " << camera.fov_rad;
      const auto dual = film_from_direction(camera, DualVec3(direction.x, direction.y, direction.z));
      EXPECT_EQ(dual->x.v, back->x);
      EXPECT_EQ(dual->y.v, back->y);
    }
  }
}

TEST(Projection, SomeDirectionsAreOnNoFilm) {
  const auto is_on = [](Projection projection, const Vec3& direction) {
    return film_from_direction(camera_of(projection, 800, 400, 50), direction).has_value();
  };
  for (const Vec3& level : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(1, 1, 1e-300)}) {
    EXPECT_FALSE(is_on(Projection::Perspective, level));
    EXPECT_TRUE(is_on(Projection::LatLong, level));
    EXPECT_TRUE(is_on(Projection::Fisheye, level));
  }
  EXPECT_TRUE(is_on(Projection::Perspective, {1, 1, -1e-10}));
  EXPECT_FALSE(is_on(Projection::Perspective, {0, 0, 1}));
  EXPECT_TRUE(is_on(Projection::LatLong, {0, 0, 1}));
  EXPECT_FALSE(is_on(Projection::Fisheye, {0, 0, 1}));
  EXPECT_FALSE(is_on(Projection::Fisheye, {-0.0, 0, 1e-10}));
  EXPECT_TRUE(is_on(Projection::Fisheye, {1e-20, 0, 1}));
  for (const Projection any : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    EXPECT_FALSE(is_on(any, Vec3(0)));
  }
}

TEST(Projection, LatLongSeamAndPoles) {
  const Camera camera = camera_of(Projection::LatLong, 800, 400);
  for (const double side : {0.0, -0.0, 1e-300, -1e-300, 1e-17, -1e-17}) {
    const auto film = film_from_direction(camera, Vec3(side, 0, 1));
    EXPECT_GE(film->x, 0);
    EXPECT_LT(film->x, 800);
    EXPECT_EQ(film->y, 200);
  }
  EXPECT_NEAR(film_from_direction(camera, Vec3(-1e-6, 0, 1))->x, 800 / (2 * kPi) * 1e-6, 1e-12);
  EXPECT_NEAR(film_from_direction(camera, Vec3(1e-6, 0, 1))->x, 800 - 800 / (2 * kPi) * 1e-6, 1e-12);
  for (const double up : {1.0, -1.0}) {
    const auto pole = film_from_direction(camera, DualVec3(Dual(0, 1, 2), Dual(up, 3, 4), Dual(0, 5, 6)));
    EXPECT_EQ(pole->x.v, 400);
    EXPECT_EQ(pole->y.v, up > 0 ? 0 : 400);
    for (const Dual& coordinate : {pole->x, pole->y}) EXPECT_EQ(coordinate.dx * coordinate.dy, 0);
  }
}

TEST(Projection, PixelAngleIsTheAngleBetweenPixelsInTheMiddle) {
  EXPECT_DOUBLE_EQ(pixel_angle(camera_of(Projection::LatLong, 800, 300)), 2 * kPi / 800);
  EXPECT_DOUBLE_EQ(pixel_angle(camera_of(Projection::Fisheye, 800, 400, 180)), kPi / 400);
  EXPECT_DOUBLE_EQ(pixel_angle(camera_of(Projection::Perspective, 800, 400, 90)), 2.0 / 800);
  for (const Camera& camera : cameras_of_every_kind()) {
    const DualVec3 ahead = direction_from_film<Dual>(camera, {camera.width / 2.0, camera.height / 2.0});
    EXPECT_NEAR(derivative_by_x(ahead).length() / pixel_angle(camera), 1, 1e-15);
  }
}

TEST(Projection, FieldOfViewIsTheFullHorizontalAngle) {
  for (const double fov : {1e-9, 3.0, 90.0, 179.9}) {
    const Camera camera = camera_of(Projection::Perspective, 800, 400, fov);
    const Vec3 left = direction_from_pixel(camera, {0, 200});
    const Vec3 right = direction_from_pixel(camera, {800, 200});
    EXPECT_NEAR(std::atan2(right.x, -right.z) - std::atan2(left.x, -left.z), camera.fov_rad,
                1e-14 * camera.fov_rad);
  }
}

TEST(Projection, PixelFromSlopesUndoesSlopesFromPixel) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> position(-3000, 3000);
  for (const double fov : {1e-9, 0.5, 45.0, 120.0, 179.9}) {
    const Camera camera = camera_of(Projection::Perspective, 1920, 1080, fov);
    for (int i = 0; i < 1000; ++i) {
      const FilmPosition film{position(random), position(random)};
      const FilmPosition back = pixel_from_slopes(camera, slopes_from_pixel(camera, film));
      EXPECT_NEAR(back.x, film.x, 1e-11);
      EXPECT_NEAR(back.y, film.y, 1e-11);
    }
  }
}

TEST(Projection, PerspectiveDirectionsAreUnitVectorsAlongTheSlopes) {
  const Camera camera = camera_of(Projection::Perspective, 1920, 1080, 100);
  const FilmPosition film{12.25, 1033.5};
  const Vec3 d = direction_from_pixel(camera, film);
  EXPECT_EQ(d, direction_from_film<double>(camera, film));
  EXPECT_NEAR(d.length(), 1.0, 1e-15);
  EXPECT_NEAR(d.x / -d.z, slopes_from_pixel(camera, film).right, 1e-15);
  EXPECT_NEAR(d.y / -d.z, slopes_from_pixel(camera, film).up, 1e-15);
}

}  // namespace
}  // namespace lensplane
