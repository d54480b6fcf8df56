// SPDX-License-Identifier: Apache-2.0

#include "src/film_area.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/constants.h"

namespace lensplane {
namespace {

Camera camera_of(Projection projection) {
  Camera camera;
  camera.width = 400;
  camera.height = 200;
  camera.projection = projection;
  camera.fov_rad = 1.0;
  return camera;
}

TEST(FilmArea, IsTheFilmWithOverscanAndMargin) {
  Camera camera = camera_of(Projection::Perspective);
  camera.overscan = 10;
  const FilmArea area = film_area(camera, 3);
  EXPECT_EQ(area.left, -13);
  EXPECT_EQ(area.bottom, 213);
  EXPECT_TRUE(area.contains({-13, -13}));
  EXPECT_FALSE(area.contains({413, 0}));
}

TEST(FilmArea, HoldsADirectionWhereverTheFilmSeesIt) {
  for (const Projection projection : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    Camera camera = camera_of(projection);
    camera.overscan = 60;
    const FilmArea area = film_area(camera, 0);
    // The corners too: there a lat-long film shows again what it shows elsewhere.
    for (const FilmPosition film :
         {FilmPosition{-59.5, -50.5}, {0.25, 7}, {200, 100}, {459, 259}, {399, -3}}) {
      if (!sees(camera, film)) continue;
      const Vec3 direction = direction_from_film<double>(camera, film);
      bool there = false;
      for (const FilmPosition found : films_of_direction(camera, area, direction)) {
        EXPECT_LT((direction_from_film<double>(camera, found) - direction).length(), 1e-14);
        there = there || std::hypot(found.x - film.x, found.y - film.y) < 1e-9;
      }
      EXPECT_TRUE(there) << static_cast<int>(projection) << " " << film.x << " " << film.y;
    }
  }
}

TEST(FilmArea, OfALatLongFilmRepeatsItsEdges) {
  const Camera camera = camera_of(Projection::LatLong);
  const Vec3 seam = direction_from_film<double>(camera, {1, 100}),
             pole = direction_from_film<double>(camera, {50, 1});
  EXPECT_EQ(films_of_direction(camera, film_area(camera, 0), seam).size(), 1U);
  const auto twice = films_of_direction(camera, film_area(camera, 4), seam);
  ASSERT_EQ(twice.size(), 2U);
  EXPECT_NEAR(twice[0].x, 1, 1e-9);
  EXPECT_NEAR(twice[1].x, 401, 1e-9);
  const auto over_pole = films_of_direction(camera, film_area(camera, 4), pole);
  ASSERT_EQ(over_pole.size(), 2U);
  EXPECT_NEAR(over_pole[1].x, 250, 1e-9);
  EXPECT_NEAR(over_pole[1].y, -1, 1e-9);
}

TEST(FilmArea, HoldsNothingThatTheCameraDoesNotSee) {
  const Camera flat = camera_of(Projection::Perspective), fisheye = camera_of(Projection::Fisheye);
  EXPECT_TRUE(films_of_direction(flat, film_area(flat, 1e9), Vec3(0, 0, 1)).empty());
  EXPECT_TRUE(films_of_direction(flat, film_area(flat, 1e9), Vec3(0, 0.1, 1)).empty());
  // 0.51 radians from the axis, on the film but outside the circle.
  EXPECT_TRUE(
      films_of_direction(fisheye, film_area(fisheye, 0), Vec3(std::sin(0.51), 0, -std::cos(0.51))).empty());
  EXPECT_EQ(
      films_of_direction(fisheye, film_area(fisheye, 0), Vec3(std::sin(0.49), 0, -std::cos(0.49))).size(),
      1U);
}

}  // namespace
}  // namespace lensplane
