// SPDX-License-Identifier: Apache-2.0
//
// Arrival times by the method `planes` against those of curved rays, and the logarithm of Shapiro's delay.

#include "src/arrival_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "src/geodesic.h"
#include "src/planes_march.h"
#include "src/surfaces.h"
#include "tests/src/deflector_scenes.h"

namespace lensplane {
namespace {

const std::vector<Lens> kOneMass = {{1, {0, 0, -1}}};
const std::vector<Lens> kMasses = {
    {1, {0.1, 0.2, -1}}, {2, {-0.3, 0.5, -2}}, {0.5, {1, 0.5, 0.1}}, {1, {0.2, 0.2, 1.5}}};
constexpr double kAngles[] = {0.05, 0.3, 1.0, 1.5, 1.7, 2.5, 3.1};

std::vector<Lens> times(std::vector<Lens> lenses, double k) {
  for (Lens& lens : lenses) lens.m *= k;
  return lenses;
}

std::vector<PointMass> masses_of(const std::vector<Lens>& lenses) {
  std::vector<PointMass> masses;
  for (const Lens& lens : lenses) masses.push_back({lens.m, lens.position});
  return masses;
}

/// By how much the delays by `planes` and by curved rays differ, for light from infinity.
double apart(const std::vector<Lens>& lenses, double angle) {
  const double curved = trace_geodesic<double>(masses_of(lenses), Vec3(0), at_angle(angle), 1e-16).delay;
  const auto path = march_planes<double>(round_deflectors(lenses, Law::Exact), at_angle(angle));
  return meet(LatLong{}, Camera{}, {0, 0}, path).delay - curved;
}

TEST(ArrivalTime, OfLightFromInfinityIsThatOfCurvedRaysToFirstOrder) {
  // Masses of about m/2 at about unit distance. What is left is of second order.
  for (const double angle : kAngles) {
    for (const auto& lenses : {kOneMass, kMasses}) {
      const double apart_by_1e5 = apart(times(lenses, 1e-5), angle);
      EXPECT_LT(std::abs(apart_by_1e5), 100 * 1e-10) << angle;
      EXPECT_NEAR(apart(times(lenses, 1e-6), angle) / apart_by_1e5, 0.01, 1e-4) << angle;
    }
  }
}

/// How differently straight stretches and curved rays see a ball: in (s, t), and in metres of delay.
struct BallErrors {
  double st, delay;
};

BallErrors errors_on(const Sphere& ball, const std::vector<Lens>& lenses, const Vec3& towards) {
  const Vec3 direction = towards.normalized();
  const Ball same{ball.centre, ball.radius};
  const auto masses = masses_of(lenses);
  const auto curved = trace_geodesic<double>(masses, Vec3(0), direction, 1e-16, {{&same, 1}}).hits[0];
  const Deflectors deflectors = round_deflectors(lenses, Law::Exact);
  const auto ours = meet(ball, Camera{}, {0, 0}, march_planes<double>(deflectors, direction), &deflectors);
  EXPECT_TRUE(curved.hit);
  EXPECT_EQ(ours.outcome, Outcome::Hit);
  const TexturePoint<double> st = st_from_sphere_normal(curved.point - ball.centre);
  return {std::hypot(ours.st.s - st.s, ours.st.t - st.t), std::abs(ours.delay - curved.delay)};
}

TEST(FiniteDistance, BallsAreSeenAsByCurvedRaysToFirstOrder) {
  // Behind the masses, between them and before them, beside and behind the camera, and through their planes:
  // places and times are right to first order, what is left falls with the square of the masses.
  const struct {
    Sphere ball;
    Vec3 towards;
  } kBalls[] = {{{{0.2, 0.3, -3}, 1, {}}, {0.1, 0.1, -1}},
                {{{0.2, 0.3, -1}, 0.5, {}}, {0.2, 0.3, -1}},
                {{{0.2, 0.3, -0.6}, 0.2, {}}, {0.2, 0.3, -0.6}},
                {{{0.2, 0.3, 4}, 0.2, {}}, {0.2, 0.3, 4}},
                {{{0.2, 0.0, -4}, 1, {}}, {0.2, 0.0, -4}},
                {{{0.2, 1.0, -1.7}, 0.2, {}}, {0.2, 1.0, -1.7}},
                {{{3, 0.0, 2}, 1, {}}, {3, 0.1, 2}}};
  for (const auto& [ball, towards] : kBalls) {
    for (const auto& lenses : {kOneMass, kMasses}) {
      const BallErrors at_1e4 = errors_on(ball, times(lenses, 1e-4), towards);
      const BallErrors at_1e5 = errors_on(ball, times(lenses, 1e-5), towards);
      EXPECT_LT(at_1e4.st, 150 * 1e-8) << ball.centre;
      EXPECT_LT(at_1e4.delay, 250 * 1e-8) << ball.centre;
      EXPECT_LT(at_1e5.st, 0.011 * at_1e4.st) << ball.centre;
      EXPECT_LT(at_1e5.delay, 0.011 * at_1e4.delay) << ball.centre;
    }
  }
}

TEST(FiniteDistance, JacobianOnABallIsThatOfDifferences) {
  Scene scene = scene_of(Projection::Perspective, times(kMasses, 0.01));
  const struct {
    Sphere ball;
    double x, y;  // where it is on the film
  } kBalls[] = {{{{0.2, 0.3, -3}, 1, {}}, 55, 24}, {{{0.2, 0.3, -0.6}, 0.2, {}}, 78, 8}};
  for (const auto& [placed, x, y] : kBalls) {
    const Sphere& ball = placed;
    const Deflectors deflectors = deflectors_of(scene, Law::Exact, true);
    const auto st_at = [&]<class Number>(Number, double film_x, double film_y) {
      const auto first = direction_from_film<Number>(scene.camera, {film_x, film_y});
      const auto hit =
          meet(ball, scene.camera, {film_x, film_y}, march_planes<Number>(deflectors, first), &deflectors);
      EXPECT_EQ(hit.outcome, Outcome::Hit);
      return hit.st;
    };
    constexpr double h = 1e-3;
    const TexturePoint<Dual> st = st_at(Dual(), x, y);
    const auto left = st_at(0.0, x - h, y), right = st_at(0.0, x + h, y);
    const auto up = st_at(0.0, x, y - h), down = st_at(0.0, x, y + h);
    EXPECT_NEAR(st.s.dx / ((right.s - left.s) / (2 * h)), 1, 1e-6);
    EXPECT_NEAR(st.t.dx / ((right.t - left.t) / (2 * h)), 1, 1e-6);
    EXPECT_NEAR(st.s.dy / ((down.s - up.s) / (2 * h)), 1, 1e-6);
    EXPECT_NEAR(st.t.dy / ((down.t - up.t) / (2 * h)), 1, 1e-6);
  }
}

TEST(ArrivalTime, HasNoSeamWhereABallReachesThroughTheDepthOfAMass) {
  // Over a ball through whose middle the mass's plane goes, from its front towards its limb.
  const std::vector<Lens> lenses = {{1e-3, {1.2, 0, -3}}};
  const Deflectors deflectors = round_deflectors(lenses, Law::Exact);
  const Sphere ball{{0, 0, -3}, 1, {}};
  double last = 0;
  int steps = 0;
  for (double angle = 0.05; angle < 0.336; angle += 1e-4) {
    const auto hit =
        meet(ball, Camera{}, {0, 0}, march_planes<double>(deflectors, at_angle(angle)), &deflectors);
    ASSERT_EQ(hit.outcome, Outcome::Hit);
    if (steps++ > 0) {
      EXPECT_LT(std::abs(hit.delay - last), 1e-5) << angle;
    }
    last = hit.delay;
  }
}

TEST(ArrivalTime, LogarithmKeepsItsDigitsOnEitherSideOfTheMass) {
  for (const double b : {1e-9, 1e-3, 1.0}) {
    for (const auto& [z1, z2] : {std::pair{3.0, 5.0}, {3.0, -2.5}, {-2.5, 3.0}, {0.0, 1.0}, {2.0, 0.0}}) {
      const long double w = b;
      const auto part = [&](long double z) {
        const long double r = std::sqrt(z * z + w * w);
        return z >= 0 ? std::log((z + r) / w) : -std::log((r - z) / w);
      };
      const double expected = static_cast<double>(part(z1) + part(z2));
      EXPECT_NEAR(shapiro_logarithm_between(z1, z2, b), expected, 1e-15 * (1 + std::abs(expected)))
          << z1 << " " << b;
    }
  }
}

}  // namespace
}  // namespace lensplane
