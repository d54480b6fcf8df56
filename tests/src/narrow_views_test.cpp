// SPDX-License-Identifier: Apache-2.0
//
// Curved rays in views so narrow that what is passed is 1e-6 to 1e-11 of its distance away: against the
// lens equation of several planes, exact for small angles, in long double.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "src/geodesic_batch.h"
#include "src/lens_map.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

struct NarrowScene {
  double einstein_angle, distance;  // radians, metres: typical ones
  std::vector<PointMass> masses;    // nearest first, about the -z axis

  double pixel() const { return 6.0 * einstein_angle / 960.0; }
  double tolerance() const { return 0.05 * kGeodesicShare * pixel(); }
};

/// One to ten masses from a planet's to a galaxy's, in groups or far apart in depth.
NarrowScene narrow_scene(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform;
  const auto between = [&](double low, double high) { return low * std::pow(high / low, uniform(random)); };
  NarrowScene scene{between(1e-11, 1e-6), between(1e12, 1e26), {}};
  const auto [angle, distance, masses] = scene;
  const int count = 1 + static_cast<int>(10.0 * uniform(random));
  for (int i = 0; i < count; ++i) {
    const double depth = distance * (uniform(random) < 0.5 ? 1.0 + 1e-3 * uniform(random) : between(0.3, 3));
    const double m = 0.25 * angle * angle * distance * between(0.1, 1.0);
    const double x = 3.0 * angle * (uniform(random) - 0.5), y = 3.0 * angle * (uniform(random) - 0.5);
    scene.masses.push_back({m, Vec3(x, y, -1) * depth});
  }
  std::ranges::sort(scene.masses, {}, [](const PointMass& mass) { return -mass.position.z; });
  return scene;
}

/// Slopes of a ray at infinity, and how much they grow, at most, with the slopes at the camera.
struct Slopes {
  long double x, y, growth;
};

Slopes by_lens_equation(const std::vector<PointMass>& masses, const Vec3& direction) {
  struct Ray {
    long double sx, sy, x = 0, y = 0;
  };
  Ray ray{direction.x / -static_cast<long double>(direction.z),
          direction.y / -static_cast<long double>(direction.z)};
  std::array<Ray, 2> changes = {Ray{1, 0}, Ray{0, 1}};  // with the slopes at the camera
  long double depth = 0;
  for (const PointMass& mass : masses) {
    const long double way = -mass.position.z - depth, m4 = 4.0L * mass.m;
    depth = -mass.position.z;
    const auto go = [way](Ray& r) { r.x += r.sx * way, r.y += r.sy * way; };
    go(ray);
    const long double x = ray.x - mass.position.x, y = ray.y - mass.position.y, b2 = x * x + y * y;
    ray.sx -= m4 * x / b2, ray.sy -= m4 * y / b2;
    for (Ray& change : changes) {
      go(change);
      const long double along = 2 * (x * change.x + y * change.y) / b2;
      change.sx -= m4 * (change.x - x * along) / b2, change.sy -= m4 * (change.y - y * along) / b2;
    }
  }
  return {ray.sx, ray.sy,
          std::hypot(std::hypot(changes[0].sx, changes[0].sy), std::hypot(changes[1].sx, changes[1].sy))};
}

std::vector<Vec3> film_of(const NarrowScene& scene, int rays) {
  std::vector<Vec3> directions;
  for (int i = 0; i < rays * rays; ++i) {
    const double x = (i % rays + 0.5) / rays - 0.5, y = (i / rays + 0.5) / rays - 0.5;
    directions.push_back(
        Vec3(6.0 * scene.einstein_angle * x, 6.0 * scene.einstein_angle * y, -1).normalized());
  }
  return directions;
}

TEST(NarrowViews, ShowNoFalseShadowAndFollowTheLensEquation) {
  std::mt19937 random(20);
  for (int n = 0; n < 40; ++n) {
    const NarrowScene scene = narrow_scene(random);
    const auto directions = film_of(scene, 24);
    const auto rays =
        trace_geodesics<double>(scene.masses, Vec3(0), directions, scene.tolerance(), {}, {false});
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_FALSE(rays[i].captured || rays[i].unresolved) << n << ' ' << directions[i];
      const Slopes exact = by_lens_equation(scene.masses, directions[i]);
      const Vec3& d = rays[i].direction;
      const long double forward = -static_cast<long double>(d.z);
      const auto error = static_cast<double>(std::hypot(d.x / forward - exact.x, d.y / forward - exact.y));
      // What is wrong early on the way grows with what is seen.
      EXPECT_LT(error, 3.0 * scene.tolerance() * (1.0 + static_cast<double>(exact.growth))) << n << ' ' << i;
    }
  }
}

TEST(NarrowViews, DoNotDependOnWhereTheCameraLooks) {
  // The same scene far from the axes, where a direction itself is known to 1e-16 only.
  std::mt19937 random(21);
  for (int n = 0; n < 20; ++n) {
    NarrowScene scene = narrow_scene(random);
    if (scene.einstein_angle < 1e-9) continue;
    const Basis turn = basis_from_zxy({0.3 * n, 0.7 * n, 1.1 * n});
    std::vector<Vec3> directions = film_of(scene, 12);
    const auto straight = trace_geodesics<double>(scene.masses, Vec3(0), directions, scene.tolerance());
    for (PointMass& mass : scene.masses) mass.position = turn.parent_from_local(mass.position);
    std::vector<Vec3> turned = directions;
    for (Vec3& direction : turned) direction = turn.parent_from_local(direction);
    const auto rays = trace_geodesics<double>(scene.masses, Vec3(0), turned, scene.tolerance());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_FALSE(rays[i].captured || rays[i].unresolved) << n << ' ' << i;
      const double growth = static_cast<double>(by_lens_equation(
                                                    [&] {
                                                      auto masses = scene.masses;
                                                      for (PointMass& mass : masses)
                                                        mass.position = turn.local_from_parent(mass.position);
                                                      return masses;
                                                    }(),
                                                    directions[i])
                                                    .growth);
      EXPECT_NEAR((rays[i].direction - turn.parent_from_local(straight[i].direction)).length(), 0,
                  (6.0 * scene.tolerance() + 1e-14) * (1.0 + growth))
          << n << ' ' << i;
    }
  }
}

TEST(NarrowViews, DerivativesAreThoseOfTheLensEquation) {
  std::mt19937 random(22);
  for (int n = 0; n < 20; ++n) {
    const NarrowScene scene = narrow_scene(random);
    for (const Vec3& d : film_of(scene, 6)) {
      const DualVec3 dual = dual_vector(d, Vec3(1e-3, 0, 0), Vec3(0, 1e-3, 0));
      const auto ray =
          trace_geodesic<Dual>(scene.masses, DualVec3(Dual(0.0)), dual, scene.tolerance(), {}, {false, 1e-7});
      const double step = 1e-5 * scene.einstein_angle;
      const Slopes left = by_lens_equation(scene.masses, d - Vec3(step, 0, 0));
      const Slopes right = by_lens_equation(scene.masses, d + Vec3(step, 0, 0));
      const auto by_x = static_cast<double>((right.x - left.x) / (2 * step));
      const double growth = static_cast<double>(left.growth);
      EXPECT_NEAR(ray.direction.x.dx / 1e-3, by_x, 1e-3 * (1.0 + growth * growth)) << n;
    }
  }
}

/// Masses in a row beside the line of sight: light comes past one after the other.
Scene row_of_masses(int count) {
  Scene scene;
  scene.camera.width = scene.camera.height = 3;
  scene.camera.fov_rad = 1e-6;
  for (int i = 0; i < count; ++i) scene.lenses.push_back({1e-6, {1, 0, -10.0 - i}});
  scene.surfaces = {LatLong{}};
  return scene;
}

TEST(NarrowViews, WhatIsGivenUpIsNotCaptured) {
  Plan plan = plan_trace(row_of_masses(2500), Method::Geodesic);
  plan.effects.shadow = plan.effects.direction = true;
  const auto given_up = trace_maps(Tracer(row_of_masses(2500), plan));
  EXPECT_EQ(given_up[0].unresolved, 9);
  for (const float valid : given_up[0].valid) EXPECT_EQ(valid, 0.0F);
  for (const Pass& pass : given_up[0].passes) {
    for (const float value : pass.values) {
      EXPECT_TRUE(std::isfinite(value));
      if (pass.channel == "lensing.shadow") {
        EXPECT_EQ(value, 0.0F);
      }
    }
  }
  const auto seen = trace_maps(Tracer(row_of_masses(100), plan_trace(row_of_masses(100), Method::Geodesic)));
  EXPECT_EQ(seen[0].unresolved, 0);
  for (const float valid : seen[0].valid) EXPECT_EQ(valid, 1.0F);
}

}  // namespace
}  // namespace lensplane
