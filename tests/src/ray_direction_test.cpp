// SPDX-License-Identifier: Apache-2.0
//
// The pass `direction`: a unit vector in the world after the ray's last bend, of rays that meet nothing as
// far as they go; by `planes` and by `geodesic` alike.

#include <gtest/gtest.h>

#include <cmath>

#include "src/tracer.h"

namespace lensplane {
namespace {

constexpr Effects kDirection{.direction = true};
constexpr Effects kDirectionAndJacobian{.jacobian = true, .direction = true};

/// A turned camera before a light mass and, beside it, a ball; a few rays meet the ball, most miss it.
Scene turned_scene(double m) {
  Scene scene;
  scene.camera.width = 64;
  scene.camera.height = 32;
  scene.camera.fov_rad = 0.5;
  scene.camera.position = Vec3(1e3, -2e3, 3e3);
  scene.camera.axes = basis_from_zxy({0.4, -1.1, 0.7});
  const auto at = [&](const Vec3& p) {
    return scene.camera.position + scene.camera.axes.parent_from_local(p);
  };
  scene.lenses = {{m, at({0, 0, -1e6})}};
  scene.surfaces = {LatLong{}, Sphere{at({3e5, 0, -2e6}), 1e5, {}}, Plate{}};
  return scene;
}

TraceBatch traced(const Scene& scene, Method method, const Effects& effects) {
  TraceSettings settings{method, std::nullopt, 1e-6, Choice::Auto, effects};
  const Tracer tracer(scene, plan_trace(scene, settings));
  TraceBatch batch = tracer.make_batch();
  for (int i = 0; i < kBatchSize; ++i) {
    batch.x[i] = 0.5 * (i % 16) * scene.camera.width / 8;
    batch.y[i] = 0.5 * (i / 16) * scene.camera.height / 4;
  }
  tracer.trace(batch);
  return batch;
}

Vec3 direction_of(const SurfaceBatch& surface, int i) {
  return {surface.passes->dir_x[i], surface.passes->dir_y[i], surface.passes->dir_z[i]};
}

TEST(RayDirection, OfARayThatMissesABallIsThatOfTheSkyBehind) {
  const Scene scene = turned_scene(1.0);
  for (const Effects& effects : {kDirection, kDirectionAndJacobian}) {
    const TraceBatch planes = traced(scene, Method::Planes, effects);
    const TraceBatch curved = traced(scene, Method::Geodesic, effects);
    int missed = 0;
    for (int i = 0; i < kBatchSize; ++i) {
      const auto ray = static_cast<std::size_t>(i);
      for (const TraceBatch* batch : {&planes, &curved}) {
        const SurfaceBatch& ball = batch->surfaces[1];
        if (ball.outcome[ray] != Outcome::Missed) continue;
        ++missed;
        EXPECT_EQ(direction_of(ball, i), direction_of(batch->surfaces[0], i)) << i;
        EXPECT_NEAR(direction_of(ball, i).length(), 1.0, 1e-15) << i;
      }
      for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
        if (planes.surfaces[k].outcome[ray] == Outcome::Captured) continue;
        const Vec3 apart = direction_of(planes.surfaces[k], i) - direction_of(curved.surfaces[k], i);
        // On the ball `planes` has the direction from the mass to there, `geodesic` that of the curve.
        const bool on_ball = k == 1 && planes.surfaces[k].outcome[ray] == Outcome::Hit;
        EXPECT_LT(apart.length(), on_ball ? 3e-6 : 1e-9) << i;
      }
    }
    EXPECT_GT(missed, 200);
  }
}

TEST(RayDirection, OfACapturedRayIsUnbentStraightAtAMass) {
  const Scene scene = turned_scene(1e3);  // the middle ray runs straight at it
  for (const Method method : {Method::Planes, Method::Geodesic}) {
    const TraceBatch batch = traced(scene, method, kDirectionAndJacobian);
    int captured = 0;
    for (int i = 0; i < kBatchSize; ++i) {
      if (batch.surfaces[0].outcome[static_cast<std::size_t>(i)] != Outcome::Captured) continue;
      ++captured;
      ASSERT_EQ(batch.x[i], 32.0);
      ASSERT_EQ(batch.y[i], 16.0);
      for (const SurfaceBatch& surface : batch.surfaces) {
        const Vec3 ahead = scene.camera.axes.parent_from_local({0, 0, -1});
        EXPECT_LT((direction_of(surface, i) - ahead).length(), 1e-9) << name_of(method);
        EXPECT_EQ(surface.passes->ds_dx[i], 0.0);
      }
    }
    EXPECT_EQ(captured, 1) << name_of(method);
  }
}

TEST(RayDirection, OfARayThatNeverSetsOutIsThatAtTheCamera) {
  for (const Method method : {Method::Planes, Method::Geodesic}) {
    for (const double distance : {0.0, 0.3}) {  // on the mass, inside its horizon
      Scene scene = turned_scene(1.0);
      scene.lenses = {{1.0, scene.camera.position + Vec3(distance, 0, 0)}};
      const TraceBatch batch = traced(scene, method, kDirection);
      for (int i = 0; i < kBatchSize; ++i) {
        const Vec3 first = scene.camera.axes.parent_from_local(
            direction_from_film<double>(scene.camera, {batch.x[i], batch.y[i]}));
        for (const SurfaceBatch& surface : batch.surfaces) {
          ASSERT_EQ(surface.outcome[static_cast<std::size_t>(i)], Outcome::Captured);
          EXPECT_LT((direction_of(surface, i) - first).length(), 1e-15);
        }
      }
    }
  }
}

}  // namespace
}  // namespace lensplane
