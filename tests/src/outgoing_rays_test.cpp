// SPDX-License-Identifier: Apache-2.0

#include "src/outgoing_rays.h"

#include <gtest/gtest.h>

#include "src/probe.h"
#include "src/projection.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

/// A camera that is moved and turned, and masses at two depths, the nearer of them with a wide shadow.
Scene two_masses() {
  Scene scene;
  scene.camera.width = 64;
  scene.camera.height = 48;
  scene.camera.fov_rad = 0.6;
  scene.camera.position = {1, 2, 3};
  scene.camera.axes = basis_from_zxy({0.1, 0.2, 0.3});
  const auto place = [&](const Vec3& v) {
    return scene.camera.position + scene.camera.axes.parent_from_local(v);
  };
  scene.lenses = {{0.05, place({1, 0, -20})}, {0.01, place({-3, 1, -30})}};
  scene.surfaces = {LatLong{}};
  return scene;
}

std::vector<FilmPosition> films() {
  return {{3.5, 4.5}, {30.1, 20.2}, {34.2, 24}, {50.5, 40.5}, {-10, 60}};
}

TEST(OutgoingRays, StraightLightLeavesTheCamera) {
  Scene scene = two_masses();
  for (Lens& lens : scene.lenses) lens.m = 0.0;
  for (const Method method : {Method::Planes, Method::ShinotsukaMakino, Method::Geodesic}) {
    const Plan plan = plan_trace(scene, method);
    EXPECT_FALSE(bends_light(scene, plan));
    const auto rays = outgoing_rays(scene, plan, films());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_FALSE(rays[i].lightless);
      const Vec3 first = direction_from_pixel(scene.camera, films()[i]);
      EXPECT_NEAR((rays[i].direction - first).length(), 0.0, 1e-15);
      EXPECT_NEAR(rays[i].start.cross(first).length(), 0.0, 1e-12);
    }
  }
}

TEST(OutgoingRays, PointWhereProbesDo) {
  const Scene scene = two_masses();
  for (const Method method : {Method::Planes, Method::ShinotsukaMakino, Method::Geodesic}) {
    const Plan plan = plan_trace(scene, method);
    EXPECT_TRUE(bends_light(scene, plan));
    const auto rays = outgoing_rays(scene, plan, films());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Vec3 last = scene.camera.axes.local_from_parent(probe(scene, plan, films()[i]).last);
      // With derivatives curved rays take other steps.
      const double error = method == Method::Geodesic ? plan.geodesic_tolerance : 1e-12;
      EXPECT_NEAR((rays[i].direction - last).length(), 0.0, error) << i;
    }
  }
}

TEST(OutgoingRays, CurvedLightAndPlanesAgreeOnTheLine) {
  // Between the two, at the Einstein radius, some hundredths: both are second order there.
  constexpr double kLine_m = 0.03;
  const Scene scene = two_masses();
  const auto planes = outgoing_rays(scene, plan_trace(scene, Method::Planes), films());
  const auto curved = outgoing_rays(scene, plan_trace(scene, Method::Geodesic), films());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Vec3 apart = curved[i].start - planes[i].start;
    EXPECT_LT(apart.cross(planes[i].direction).length(), kLine_m) << i;
  }
}

TEST(OutgoingRays, ThereIsNoLightFromAMass) {
  const Scene scene = two_masses();
  const auto hole = *film_from_direction<double>(
      scene.camera, scene.camera.axes.local_from_parent(scene.lenses[0].position - scene.camera.position));
  const FilmPosition film{hole.x, hole.y};
  for (const Method method : {Method::Planes, Method::Geodesic})
    EXPECT_TRUE(outgoing_rays(scene, plan_trace(scene, method), {{film}}).front().lightless);
}

TEST(OutgoingRays, LeadFromPlaneToPlane) {
  const Scene scene = two_masses();
  const Plan plan = plan_trace(scene, Method::Planes);
  const auto depths = bend_depths(scene, plan);
  ASSERT_EQ(depths.size(), 2U);
  EXPECT_NEAR(depths[0], 20.0, 1e-9);
  EXPECT_NEAR(depths[1], 30.0, 1e-9);
  EXPECT_NEAR(bend_depths(scene, plan_trace(scene, Method::Geodesic)).front(), 20.0, 1e-9);
  const auto at_camera = rays_after(scene, plan, 0, films()), between = rays_after(scene, plan, 1, films()),
             last = rays_after(scene, plan, 2, films()), all = outgoing_rays(scene, plan, films());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(at_camera[i].start, Vec3(0));
    EXPECT_EQ(last[i].start, all[i].start);
    EXPECT_EQ(last[i].direction, all[i].direction);
    // After the first mass light begins near it, and has not yet passed the second.
    EXPECT_GT(between[i].start.z, -21.0);
    EXPECT_GT(between[i].direction.dot(at_camera[i].direction), 0.8);
    EXPECT_NE(between[i].direction, last[i].direction);
    EXPECT_NE(between[i].direction, at_camera[i].direction);
  }
}

}  // namespace
}  // namespace lensplane
