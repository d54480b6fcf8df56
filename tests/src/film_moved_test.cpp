// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "src/projection.h"
#include "tests/src/projections.h"

namespace lensplane {
namespace {

TEST(FilmMoved, StaysBitForBitWhereNothingBends) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> position(-300, 2300);
  for (const Camera& camera : cameras_of_every_kind()) {
    for (int i = 0; i < 1000; ++i) {
      const FilmPosition film{position(random), position(random)};  // overscan, too
      const Vec3 direction = direction_from_film<double>(camera, film);
      const auto moved = film_moved(camera, film, direction, direction);
      ASSERT_TRUE(moved);
      EXPECT_EQ(moved->x, film.x);
      EXPECT_EQ(moved->y, film.y);
      const DualVec3 dual_direction = direction_from_film<Dual>(camera, film);
      const auto dual = film_moved(camera, film, dual_direction, dual_direction);
      EXPECT_EQ(dual->x.v, film.x);
      EXPECT_EQ(dual->y.v, film.y);
      EXPECT_EQ(Vec3(dual->x.dx, dual->x.dy, 0), Vec3(1, 0, 0));
      EXPECT_EQ(Vec3(dual->y.dx, dual->y.dy, 0), Vec3(0, 1, 0));
    }
  }
}

/// How much larger than in its middle the film shows the surroundings of a direction, where that has no
/// limit.
double enlargement(const Camera& camera, const Vec3& direction) {
  if (camera.projection == Projection::LatLong) return 1 / std::hypot(direction.x, direction.z);
  if (camera.projection == Projection::Perspective) return 1;
  const double away = std::hypot(direction.x, direction.y);
  return std::atan2(away, -direction.z) / away;
}

/// The distance moved, seen free of the rounding of film coordinates: from the film's corner, where they are
/// 0. East of there, for lat-long.
TEST(FilmMoved, MovesByTheDifferenceToItsLastDigits) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> digits(-7, 3);
  for (const Camera& camera : cameras_of_every_kind()) {
    for (int i = 0; i < 500; ++i) {
      const FilmPosition film = random_position(camera, random);
      const double pixels = std::pow(10.0, digits(random));
      FilmPosition other{film.x + pixels * normal(random), film.y + pixels * normal(random)};
      if (!sees(camera, other)) other = random_position(camera, random);
      Vec3 first = direction_from_film<double>(camera, film);
      Vec3 last = direction_from_film<double>(camera, other);
      RealFilm from = reference_film(camera, in_reference(first));
      RealFilm to = reference_film(camera, in_reference(last));
      if (camera.projection == Projection::LatLong && to[0] < from[0]) {
        std::swap(first, last);
        std::swap(from, to);
      }
      const auto moved = film_moved(camera, {0, 0}, first, last);
      ASSERT_TRUE(moved);
      const Real x = to[0] - from[0], y = to[1] - from[1];
      const auto error = static_cast<double>(hypot(Real(moved->x - x), Real(moved->y - y)) / hypot(x, y));
      const double enlarged = std::max(enlargement(camera, first), enlargement(camera, last));
      EXPECT_LT(error, kFilmShiftError * enlarged)
          << static_cast<int>(camera.projection) << " " << camera.fov_rad << " " << film.x << " " << film.y
          << " by " << x << " " << y;
    }
  }
}

TEST(FilmMoved, LeadsToWhereTheLastDirectionLies) {
  std::mt19937 random(3);
  for (const Camera& camera : cameras_of_every_kind()) {
    for (int i = 0; i < 1000; ++i) {
      const FilmPosition film = random_position(camera, random), other = random_position(camera, random);
      const DualVec3 first = direction_from_film<Dual>(camera, film);
      // How the last direction changes with the film is anything.
      const DualVec3 last =
          dual_vector(direction_from_film<double>(camera, other) * 2.5, derivative_by_y(first) * 0.3,
                      derivative_by_x(first) + derivative_by_y(first) * 2.0);
      const auto moved = film_moved(camera, film, first, last);
      const auto expected = film_from_direction(camera, last);
      ASSERT_TRUE(moved && expected);
      EXPECT_NEAR(moved->x.v, expected->x.v, 1e-11);
      EXPECT_NEAR(moved->y.v, expected->y.v, 1e-11);
      const double size = 1 + std::abs(expected->x.dx) + std::abs(expected->x.dy) + std::abs(expected->y.dx) +
                          std::abs(expected->y.dy);
      EXPECT_NEAR(moved->x.dx, expected->x.dx, 1e-12 * size);
      EXPECT_NEAR(moved->x.dy, expected->x.dy, 1e-12 * size);
      EXPECT_NEAR(moved->y.dx, expected->y.dx, 1e-12 * size);
      EXPECT_NEAR(moved->y.dy, expected->y.dy, 1e-12 * size);
      EXPECT_EQ(film_moved(camera, film, value_of(first), value_of(last))->x, moved->x.v);
    }
  }
}

TEST(FilmMoved, GoesRoundTheLatLongSeam) {
  const Camera camera = camera_of(Projection::LatLong, 800, 400);
  const auto moved_x = [&](double x, double to) {
    const Vec3 first = direction_from_film<double>(camera, {x, 150});
    return film_moved(camera, {x, 150}, first, direction_from_film<double>(camera, {to, 150}))->x;
  };
  EXPECT_NEAR(moved_x(0.5, -0.5), 799.5, 1e-12);
  EXPECT_NEAR(moved_x(799.5, 800.5), 0.5, 1e-12);
  EXPECT_NEAR(moved_x(-3, -2), 798, 1e-12);  // overscan
  EXPECT_NEAR(moved_x(803, 802), 2, 1e-12);
  // West of 0 by less than shows next to the width.
  const Vec3 back = direction_from_film<double>(camera, {0, 200});
  const auto moved = film_moved(camera, {0, 200}, back, back + Vec3(1e-25, 0, 0));
  EXPECT_EQ(moved->x, 0);
}

TEST(FilmMoved, GoesOverTheLatLongPoles) {
  const Camera camera = camera_of(Projection::LatLong, 800, 400);
  for (const FilmPosition film : {FilmPosition{130, 3}, {130, -3}, {700, 398}, {20, 404}}) {
    for (const FilmPosition other : {FilmPosition{131, 5}, {130, -2}, {530, 1}, {400, 399}, {90, 407}}) {
      const DualVec3 first = direction_from_film<Dual>(camera, film);
      const DualVec3 last = direction_from_film<Dual>(camera, other);
      const auto moved = film_moved(camera, film, first, last);
      const DualVec3 there = direction_from_film<Dual>(camera, {moved->x.v, moved->y.v});
      EXPECT_LT((value_of(there) - value_of(last)).length(), 1e-14);
      // As the last direction changes with the film, so does the position that looks along it.
      const Vec3 by_x = derivative_by_x(there) * moved->x.dx + derivative_by_y(there) * moved->y.dx;
      const Vec3 by_y = derivative_by_x(there) * moved->x.dy + derivative_by_y(there) * moved->y.dy;
      EXPECT_LT((by_x - derivative_by_x(last)).length(), 1e-14);
      EXPECT_LT((by_y - derivative_by_y(last)).length(), 1e-14);
    }
  }
}

TEST(FilmMoved, GoesNowhereWhereTheFilmHasNoSuchDirection) {
  const auto moves = [](Projection projection, const Vec3& last) {
    return film_moved(camera_of(projection, 800, 400, 50), {400, 200}, Vec3(0, 0, -1), last).has_value();
  };
  EXPECT_FALSE(moves(Projection::Perspective, {1, 0, 0}));
  EXPECT_FALSE(moves(Projection::Perspective, {1, 0, 2}));
  EXPECT_TRUE(moves(Projection::Fisheye, {1, 0, 2}));
  EXPECT_FALSE(moves(Projection::Fisheye, {0, 0, 1}));
  EXPECT_TRUE(moves(Projection::LatLong, {0, 0, 1}));
  EXPECT_TRUE(moves(Projection::LatLong, {0, 1, 0}));
  for (const Projection any : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    EXPECT_FALSE(moves(any, Vec3(0)));
  }
}

}  // namespace
}  // namespace lensplane
