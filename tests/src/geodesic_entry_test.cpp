// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic_entry.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/src/schwarzschild.h"

namespace lensplane {
namespace {

TEST(GeodesicEntry, LongStepsDoNotMissASmallBall) {
  // Balls from a tenth to 1e-7 of the way, met in the middle and close to the edge, far behind the mass.
  const std::array masses = {PointMass{1.0, Vec3(300, 0, -1e4)}};
  for (const double distance : {3e3, 1.1e4, 1e6, 1e9}) {
    const std::array screen = {Ball{Vec3(0, 0, -2 * distance), distance}};
    const auto there = trace(masses, Vec3(0, 0, -1), kFine, screen).hits[0];
    ASSERT_TRUE(there.hit);
    const Vec3 across = Vec3(0, 1, 0);
    for (const double radius : {0.1 * distance, 1e-3 * distance, 1e-7 * distance}) {
      for (const double offset : {0.0, 0.5, 0.99, 1.01, 2.0}) {
        const std::array ball = {Ball{there.point + across * (offset * radius), radius}};
        for (const double tolerance : {1e-4, 1e-9}) {
          const auto hit = trace(masses, Vec3(0, 0, -1), tolerance, ball).hits[0];
          const bool certain = 1e-3 * radius > tolerance * distance;
          if (!certain) continue;
          EXPECT_EQ(hit.hit, offset < 1.0) << distance << ' ' << radius << ' ' << offset;
          if (hit.hit) {
            EXPECT_NEAR((hit.point - ball[0].centre).length(), radius, 1e-14 * distance);
            const double before = std::sqrt(1.0 - offset * offset) * radius;
            EXPECT_NEAR(there.length - hit.length, before, 2.0 * tolerance * distance + 0.1 * before);
          }
        }
      }
    }
  }
}

TEST(GeodesicEntry, NearlyStraightLightMissesNoBall) {
  // So little bent that a step and its chord differ by less than rounding.
  const std::array masses = {PointMass{5e-3, Vec3(0, 0, -1e9)}};
  for (int n = 0; n < 200; ++n) {
    const Vec3 direction = Vec3(1e-6 + 3e-8 * n, 2e-7 * (n % 7), -1).normalized();
    const auto ray = trace(masses, direction, 1e-12);
    const Vec3 there = ray.position + ray.direction * 2e9;
    for (const double offset : {0.0, 0.5, 0.9}) {
      const std::array ball = {Ball{there + Vec3(0, offset * 150.0, 0), 150.0}};
      EXPECT_TRUE(trace(masses, direction, 1e-12, ball).hits[0].hit) << n << ' ' << offset;
    }
  }
}

TEST(GeodesicEntry, HitsABallBeforeItIsCaptured) {
  const auto masses = mass_ahead(30);
  const std::array balls = {Ball{masses[0].position, 4.0}, Ball{masses[0].position, 0.1},
                            Ball{masses[0].position, 0.6}};
  const auto ray = trace(masses, Vec3(0, 0, -1), 1e-9, balls);
  EXPECT_TRUE(ray.captured);
  ASSERT_TRUE(ray.hits[0].hit);
  EXPECT_NEAR(ray.hits[0].length, rho_from_r(30) - 4.0, 1e-8);
  EXPECT_FALSE(ray.hits[1].hit);  // behind the horizon
  ASSERT_TRUE(ray.hits[2].hit);   // inside the photon sphere
  EXPECT_NEAR(ray.hits[2].length, rho_from_r(30) - 0.6, 1e-8);
  EXPECT_EQ(ray.direction, Vec3(0, 0, -1));  // as far as it goes
}

}  // namespace
}  // namespace lensplane
