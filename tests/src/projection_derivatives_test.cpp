// SPDX-License-Identifier: Apache-2.0
//
// The derivatives of projections, against central differences of the definitions in 50 digits: the
// differences are right to some 30 digits, so that only the roundings of projection.h show.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "src/projection.h"
#include "tests/src/projections.h"

namespace lensplane {
namespace {

Vec3 direction_difference(const Camera& camera, FilmPosition film, int axis) {
  const Real kStep("1e-15");  // pixels
  RealFilm before = {film.x, film.y}, after = before;
  before[axis] -= kStep;
  after[axis] += kStep;
  const RealVec3 a = reference_direction(camera, before), b = reference_direction(camera, after);
  Vec3 difference(0);
  for (int i = 0; i < 3; ++i) difference[i] = static_cast<double>((b[i] - a[i]) / (2 * kStep));
  return difference;
}

void expect_derivatives(const Camera& camera, FilmPosition film, double bound) {
  const DualVec3 direction = direction_from_film<Dual>(camera, film);
  const Vec3 by_x = direction_difference(camera, film, 0), by_y = direction_difference(camera, film, 1);
  EXPECT_LT((derivative_by_x(direction) - by_x).length(), bound * by_x.length())
      << static_cast<int>(camera.projection) << " " << camera.fov_rad << " " << film.x << " " << film.y;
  EXPECT_LT((derivative_by_y(direction) - by_y).length(), bound * by_y.length())
      << static_cast<int>(camera.projection) << " " << camera.fov_rad << " " << film.x << " " << film.y;
}

TEST(ProjectionDerivatives, OfDirectionsAreThoseOfTheDefinitions) {
  std::mt19937 random(1);
  for (const Camera& camera : cameras_of_every_kind()) {
    for (int i = 0; i < 100; ++i) expect_derivatives(camera, random_position(camera, random), 1e-12);
  }
}

TEST(ProjectionDerivatives, OfAFisheyeAreExactInItsMiddle) {
  for (const double fov : {1e-9, 3.0, 180.0, 360.0}) {
    const Camera camera = camera_of(Projection::Fisheye, 800, 400, fov);
    for (const double off : {1e-12, 1e-6, 1e-3, 0.5}) {
      expect_derivatives(camera, {400 + off, 200 - 0.7 * off}, 1e-15);
    }
    const DualVec3 ahead = direction_from_film<Dual>(camera, {400, 200});
    EXPECT_EQ(derivative_by_x(ahead), Vec3(camera.fov_rad / 400, 0, 0));
    EXPECT_EQ(derivative_by_y(ahead), Vec3(0, -camera.fov_rad / 400, 0));
  }
}

TEST(ProjectionDerivatives, OfALatLongAreFiniteAtItsPoles) {
  const Camera camera = camera_of(Projection::LatLong, 800, 400);
  const double angle = kPi / 400;
  for (const double up : {1.0, -1.0}) {
    const double y = up > 0 ? 0 : 400;
    const DualVec3 middle = direction_from_film<Dual>(camera, {400, y});
    EXPECT_LT(derivative_by_x(middle).length(), 1e-17);
    EXPECT_LT((derivative_by_y(middle) - Vec3(0, 0, -up * angle)).length(), 1e-17);
    const DualVec3 quarter = direction_from_film<Dual>(camera, {600, y});
    EXPECT_LT((derivative_by_y(quarter) - Vec3(up * angle, 0, 0)).length(), 1e-17);
  }
  // Overscan beyond a pole runs down the other side.
  expect_derivatives(camera, {130, -17}, 1e-12);
  expect_derivatives(camera, {-13, 431}, 1e-12);
}

/// How the film position changes with `change` of the direction, per unit.
FilmPosition film_difference(const Camera& camera, const Vec3& direction, const Vec3& change) {
  const Real kStep("1e-22");  // far below the directions across the narrowest pixel
  RealVec3 before = in_reference(direction), after = before;
  for (int i = 0; i < 3; ++i) {
    before[i] -= kStep * change[i];
    after[i] += kStep * change[i];
  }
  const RealFilm a = reference_film(camera, before), b = reference_film(camera, after);
  return {static_cast<double>((b[0] - a[0]) / (2 * kStep)), static_cast<double>((b[1] - a[1]) / (2 * kStep))};
}

TEST(ProjectionDerivatives, OfFilmPositionsAreThoseOfTheDefinitions) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (const Camera& camera : cameras_of_every_kind()) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 direction = direction_from_film<double>(camera, random_position(camera, random)) * 3.7;
      const Vec3 by_x(normal(random), normal(random), normal(random));
      const Vec3 by_y(normal(random), normal(random), normal(random));
      const auto film = film_from_direction(camera, dual_vector(direction, by_x, by_y));
      ASSERT_TRUE(film);
      const auto expect = [&](double dx, double dy, const FilmPosition& expected) {
        const double error = std::hypot(dx - expected.x, dy - expected.y);
        EXPECT_LT(error, 1e-13 * std::hypot(expected.x, expected.y))
            << static_cast<int>(camera.projection) << " " << camera.fov_rad << " " << direction;
      };
      expect(film->x.dx, film->y.dx, film_difference(camera, direction, by_x));
      expect(film->x.dy, film->y.dy, film_difference(camera, direction, by_y));
    }
  }
}

TEST(ProjectionDerivatives, OfThereAndBackAreOne) {
  std::mt19937 random(4);
  for (const Camera& camera : cameras_of_every_kind()) {
    for (int i = 0; i < 1000; ++i) {
      const FilmPosition film = random_position(camera, random);
      const auto back = film_from_direction(camera, direction_from_film<Dual>(camera, film));
      ASSERT_TRUE(back);
      const double error = std::max(
          {std::abs(back->x.dx - 1), std::abs(back->x.dy), std::abs(back->y.dx), std::abs(back->y.dy - 1)});
      EXPECT_LT(error, 1e-12) << static_cast<int>(camera.projection) << " " << camera.fov_rad << " " << film.x
                              << " " << film.y;
    }
  }
}

}  // namespace
}  // namespace lensplane
