// SPDX-License-Identifier: Apache-2.0

#include "src/ray_bundle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace lensplane {
namespace {

/// Rays that start within `apart` of one another, in directions as far apart.
std::unique_ptr<LineBatch<double>> random_rays(std::mt19937& random, double apart) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  const Vec3 start = vector() * 10, direction = vector();
  auto rays = std::make_unique<LineBatch<double>>();
  for (int i = 0; i < kBatchSize; ++i) {
    rays->start.set(i, start + vector() * apart);
    rays->direction.set(i, (direction + vector() * apart).normalized());
  }
  return rays;
}

TEST(RayBundle, HoldsForEveryRay) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int known = 0;
  for (int n = 0; n < 400; ++n) {
    const auto rays = random_rays(random, std::pow(10.0, -1 - n % 5));
    const RayBundle bundle = bundle_of(*rays);
    const Vec3 point(30 * normal(random), 30 * normal(random), 30 * normal(random));
    const auto [from, to] = bundle.along(point);
    const double distance = bundle.distance_from(point, bundle.along(point));
    known += distance > 0 ? 1 : 0;
    for (int i = 0; i < kBatchSize; ++i) {
      const Vec3 way = point - rays->start.get(i), direction = rays->direction.get(i);
      const double along = way.dot(direction);
      EXPECT_LE(from, along + 1e-12);
      EXPECT_GE(to, along - 1e-12);
      EXPECT_LE(distance, (way - direction * along).length() + 1e-12);
    }
  }
  EXPECT_GT(known, 300);
}

TEST(RayBundle, OfOneRayIsExact) {
  std::mt19937 random(6);
  const auto rays = random_rays(random, 0);
  const RayBundle bundle = bundle_of(*rays);
  const Vec3 point(3, -4, 5), way = point - rays->start.get(0), direction = rays->direction.get(0);
  const double along = way.dot(direction);
  EXPECT_NEAR(bundle.along(point).first, along, 1e-12);
  EXPECT_NEAR(bundle.along(point).second, along, 1e-12);
  EXPECT_NEAR(bundle.distance_from(point, bundle.along(point)), (way - direction * along).length(), 1e-12);
}

TEST(RayBundle, BallsHoldWhatLiesAlongTheRays) {
  std::mt19937 random(7);
  const auto rays = random_rays(random, 0.1);
  double way[kBatchSize];
  for (int i = 0; i < kBatchSize; ++i) way[i] = i;
  const PointBall ball = ball_of(rays->start, rays->direction, way);
  for (int i = 0; i < kBatchSize; ++i) {
    const Vec3 point = rays->start.get(i) + rays->direction.get(i) * way[i];
    EXPECT_LE((point - ball.centre).length(), ball.radius * (1 + 1e-12));
  }
}

}  // namespace
}  // namespace lensplane
