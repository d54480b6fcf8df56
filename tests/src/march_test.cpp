// SPDX-License-Identifier: Apache-2.0

#include "src/march.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "src/constants.h"
#include "tests/src/flat_plane.h"

namespace lensplane {
namespace {

using Vec3l = std::array<long double, 3>;

Vec3l minus(const Vec3l& a, const Vec3l& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3l plus(const Vec3l& a, const Vec3l& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vec3l times(const Vec3l& a, long double k) {
  return {a[0] * k, a[1] * k, a[2] * k};
}
long double length(const Vec3l& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}
Vec3l unit(const Vec3l& a) {
  return times(a, 1 / length(a));
}
Vec3l cross(const Vec3l& a, const Vec3l& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Equations (1) to (6) of the paper, as they are printed there.
Vec3l bend_by_hand(const Vec3l& v_ray, const Vec3l& p_g, const Vec3l& q, long double m) {
  const Vec3l v_g = unit(minus(p_g, q));                    // (1)
  const Vec3l v_n = unit(cross(v_g, v_ray));                // (2)
  const Vec3l v_rot = unit(cross(v_ray, v_n));              // (3)
  const long double alpha = 4 * m / length(minus(p_g, q));  // (4)
  const Vec3l v = times(v_rot, std::tan(alpha));            // (5)
  return unit(plus(v, v_ray));                              // (6)
}

void expect_same_direction(const Vec3& ours, const Vec3l& by_hand, double tolerance) {
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(ours[k], static_cast<double>(by_hand[static_cast<std::size_t>(k)]), tolerance);
}

TEST(Bend, IsThePapersEquations) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 direction = Vec3(0.3 * normal(random), 0.3 * normal(random), -1).normalized();
    const Vec3 to_source(normal(random), normal(random), 0);
    const double alpha = std::min(std::pow(10.0, -6 + 7 * (i % 100) / 100.0), 1.5);  // below 90 deg
    const double m = alpha * to_source.length() / 4;
    const auto bent = bend(direction, to_source, m);
    ASSERT_TRUE(bent);
    const Vec3l ray{direction.x, direction.y, direction.z};
    const Vec3l q{0, 0, 0}, p{to_source.x, to_source.y, to_source.z};
    expect_same_direction(*bent, bend_by_hand(unit(ray), p, q, m), 1e-15);
  }
}

TEST(Bend, RotatesByAlphaTowardsTheSourceBeyondARightAngle) {
  const double pi = kPi;
  for (const double alpha : {0.6 * pi, 0.99 * pi, 1.4 * pi, 5.3 * pi}) {
    const auto bent = bend<double>({0, 0, -1}, {2, 0, 0}, alpha * 2 / 4);
    ASSERT_TRUE(bent);
    EXPECT_NEAR(bent->x, std::sin(alpha), 1e-14);
    EXPECT_EQ(bent->y, 0);
    EXPECT_NEAR(bent->z, -std::cos(alpha), 1e-14);
  }
}

TEST(Bend, OnTheSourceOrStraightAtItIsCaptured) {
  EXPECT_FALSE(bend<double>({0, 0, -1}, {0, 0, 0}, 1));
  EXPECT_FALSE(bend<double>({1, 0, 0}, {5, 0, 0}, 1));        // V_g parallel to V_ray
  EXPECT_FALSE(bend<double>({0, 0, -1}, {1e-310, 0, 0}, 1));  // alpha is no number any more
}

TEST(Bend, StaysFiniteFromTheSmallestToTheLargestImpactParameters) {
  for (int exponent = -300; exponent <= 300; exponent += 5) {
    const auto bent = bend(Vec3(0.1, 0.2, -1).normalized(), Vec3(0.6, -0.8, 0) * std::pow(10.0, exponent), 1);
    ASSERT_TRUE(bent) << exponent;
    EXPECT_NEAR(bent->length(), 1, 1e-14) << exponent;
  }
}

/// A ray through three planes, each with two sources, all by hand.
TEST(March, FollowsThePapersStepsThroughSeveralPlanes) {
  const std::vector<LensPlane> planes = {flat_plane(-4e8, {{15000, 3e6, 1e6}, {9000, -2e6, 5e5}}),
                                         flat_plane(-5e8, {{14000, 1e6, -4e6}, {8000, 6e6, 2e6}}),
                                         flat_plane(-6e8, {{13000, -1e6, -1e6}, {20000, 2e6, 7e6}})};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> slope(-0.02, 0.02);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 direction = Vec3(slope(random), slope(random), -1).normalized();
    const RayPath<double> path = march(planes, Vec3(0), direction);
    ASSERT_EQ(path.segments.size(), 4U);
    EXPECT_FALSE(path.captured);

    Vec3l position{0, 0, 0}, ray = unit({direction.x, direction.y, direction.z});
    for (const LensPlane& plane : planes) {
      position = plus(position, times(ray, (-plane.distance - position[2]) / ray[2]));
      for (const Source& s : plane.sources) {
        ray = bend_by_hand(ray, {s.position.x, s.position.y, s.position.z}, position, s.m);
      }
    }
    expect_same_direction(path.segments.back().direction, ray, 1e-14);
    EXPECT_NEAR(path.segments.back().start.x, static_cast<double>(position[0]), 1e-6);
    EXPECT_NEAR(path.segments.back().start.y, static_cast<double>(position[1]), 1e-6);
    EXPECT_EQ(path.segments.back().start.z, -6e8);
  }
}

TEST(March, SegmentsJoinUp) {
  const std::vector<LensPlane> planes = {flat_plane(-10, {{0.01, 1, 0}}), flat_plane(-20, {{0.01, 0, 1}})};
  const RayPath<double> path = march(planes, Vec3(0), Vec3(0.05, 0, -1).normalized());
  ASSERT_EQ(path.segments.size(), 3U);
  for (std::size_t k = 0; k + 1 < path.segments.size(); ++k) {
    const RaySegment<double>& segment = path.segments[k];
    const Vec3 end = segment.start + segment.direction * segment.length;
    EXPECT_NEAR((end - path.segments[k + 1].start).length(), 0, 1e-14);
  }
  EXPECT_TRUE(std::isinf(path.segments.back().length));
}

TEST(March, PlanesBesideAndBehindTheCameraDoNotBend) {
  const std::vector<LensPlane> planes = {flat_plane(5, {{1, 1, 0}}), flat_plane(0, {{1, 1, 0}})};
  const RayPath<double> path = march(planes, Vec3(0), Vec3(0, 0, -1));
  EXPECT_EQ(path.segments.size(), 1U);
  EXPECT_EQ(path.segments[0].direction, Vec3(0, 0, -1));
}

TEST(March, RayOnASourceIsCapturedThere) {
  const RayPath<double> path = march({flat_plane(-10, {{1, 0, 0}})}, Vec3(0), Vec3(0, 0, -1));
  EXPECT_TRUE(path.captured);
  ASSERT_EQ(path.segments.size(), 1U);
  EXPECT_EQ(path.segments[0].length, 10);
}

TEST(March, RayThatTurnsBackGoesOnBackwardsAndIsBentAgain) {
  // alpha = 3 rad at the far plane sends the ray back through the near one and past the camera.
  const std::vector<LensPlane> planes = {flat_plane(10, {{1e-3, 1, 0}}), flat_plane(-10, {{1e-3, 1, 0}}),
                                         flat_plane(-20, {{0.75, 1, 0}})};
  const RayPath<double> path = march(planes, Vec3(0), Vec3(0, 0, -1));
  EXPECT_FALSE(path.captured);
  ASSERT_EQ(path.segments.size(), 5U);  // there: -10, -20; back: -10, 10
  EXPECT_LT(path.segments[1].direction.z, 0);
  EXPECT_GT(path.segments[2].direction.z, 0);
  EXPECT_EQ(path.segments[3].start.z, -10);
  EXPECT_EQ(path.segments[4].start.z, 10);
  EXPECT_TRUE(std::isinf(path.segments[4].length));
}

TEST(March, RayParallelToThePlanesGoesOnForEver) {
  const RayPath<double> path = march({flat_plane(-10, {{1, 3, 0}})}, Vec3(0), Vec3(1, 0, 0));
  EXPECT_EQ(path.segments.size(), 1U);
  const RayPath<double> nearly = march({flat_plane(-10, {{1, 3, 0}})}, Vec3(0), Vec3(1, 0, -1e-310));
  EXPECT_EQ(nearly.segments.size(), 1U);
}

TEST(March, EndsWhenThePlanesKeepTheRay) {
  // Two mirrors: alpha = pi from a mass so far aside that the ray stays where it is.
  const double far = 1e9;
  const std::vector<LensPlane> planes = {flat_plane(10, {{kPi * far / 4, far, 0}}),
                                         flat_plane(-10, {{kPi * far / 4, far, 0}})};
  const RayPath<double> path = march(planes, Vec3(0), Vec3(0, 0, -1));
  EXPECT_FALSE(path.captured);  // no mass has it
  EXPECT_TRUE(path.unresolved);
  EXPECT_EQ(path.segments.size(), static_cast<std::size_t>(kMaxCrossings) + 1);
}

}  // namespace
}  // namespace lensplane
