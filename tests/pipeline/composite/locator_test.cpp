// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/locator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/constants.h"

namespace lensplane {
namespace {

Scene scene_of(Projection projection, double fov_rad) {
  Scene scene;
  scene.camera.width = 200;
  scene.camera.height = 100;
  scene.camera.projection = projection;
  scene.camera.fov_rad = fov_rad;
  scene.camera.position = {1, 2, 3};
  scene.lenses = {{1, {1, 2, -7}}, {1, {1, 2, 23}}, {1, {31, 2, 3}}, {1, {1, 42, 3}}, {1, {1, 2, 3}}};
  return scene;
}

std::vector<Sphere> markers_of(const Scene& scene) {
  std::vector<Sphere> markers;
  for (const Surface& surface : make_locator(scene, {}).scene.surfaces)
    markers.push_back(std::get<Sphere>(surface));
  return markers;
}

TEST(Locator, PerspectiveShowsTheLensesAhead) {
  const auto markers = markers_of(scene_of(Projection::Perspective, 60 * kPi / 180));
  ASSERT_EQ(markers.size(), 1U);
  EXPECT_EQ(markers[0].centre, Vec3(1, 2, -7));
  // A twentieth of the frame's width, seen at the depth of the nearest lens.
  EXPECT_NEAR(markers[0].radius, 0.05 * 10 * 2 * std::tan(kPi / 6), 1e-12);
}

TEST(Locator, MarkersDoNotReachTheCamera) {
  const auto markers = markers_of(scene_of(Projection::Perspective, 179.9 * kPi / 180));
  ASSERT_EQ(markers.size(), 1U);
  EXPECT_LE(markers[0].radius, 5);
}

TEST(Locator, ViewsAllAroundShowTheLensesAllAround) {
  for (const Projection projection : {Projection::LatLong, Projection::Fisheye}) {
    const Scene scene = scene_of(projection, 2 * kPi);
    const auto markers = markers_of(scene);
    ASSERT_EQ(markers.size(), 4U);  // that in the camera itself is nowhere to be seen
    for (std::size_t i = 0; i < markers.size(); ++i) {
      EXPECT_EQ(markers[i].centre, scene.lenses[i].position);
      EXPECT_EQ(markers[i].radius, markers[0].radius);
      const Vec3 to_camera = (scene.camera.position - markers[i].centre).normalized();
      EXPECT_LT((markers[i].axes.z - to_camera).length(), 1e-14) << i;
    }
    EXPECT_GT(markers[0].radius, 0.5);
    EXPECT_LE(markers[0].radius, 5);
  }
}

}  // namespace
}  // namespace lensplane
