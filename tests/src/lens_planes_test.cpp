// SPDX-License-Identifier: Apache-2.0

#include "src/lens_planes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/constants.h"

namespace lensplane {
namespace {

Scene scene_with(std::vector<Lens> lenses) {
  Scene scene;
  scene.camera.width = scene.camera.height = 100;
  scene.camera.fov_rad = 0.1;
  scene.lenses = std::move(lenses);
  return scene;
}

TEST(LensPlanes, StandInTheOrderOfTheirDepth) {
  const auto planes = lens_planes(scene_with({{3, {0, 0, -30}}, {1, {0, 0, -10}}, {2, {0, 0, -20}}}),
                                  Method::ShinotsukaMakino);
  ASSERT_EQ(planes.size(), 3U);
  EXPECT_EQ(planes[0].distance, 10);
  EXPECT_EQ(planes[1].distance, 20);
  EXPECT_EQ(planes[2].distance, 30);
  EXPECT_EQ(planes[1].sources[0].m, 2);
}

TEST(LensPlanes, SourcesAtOneDepthShareAPlaneInFileOrder) {
  const auto planes = lens_planes(scene_with({{1, {5, 0, -10}}, {2, {0, 6, -10}}, {3, {7, 0, -11}}}),
                                  Method::ShinotsukaMakino);
  ASSERT_EQ(planes.size(), 2U);
  ASSERT_EQ(planes[0].sources.size(), 2U);
  EXPECT_EQ(planes[0].sources[0].m, 1);
  EXPECT_EQ(planes[0].sources[0].position.x, 5);
  EXPECT_EQ(planes[0].sources[1].position.y, 6);
}

TEST(LensPlanes, OneDepthIsOnePlaneForATurnedCamera) {
  // Three sources on a plane across the view of a camera that stands and looks anywhere.
  Scene scene = scene_with({});
  scene.camera.position = Vec3(1e9, -3e8, 2e10);
  scene.camera.axes = basis_from_zxy({0.3, 1.1, -0.4});
  for (const Vec3& p : {Vec3(1e6, 2e6, -1e9), Vec3(-3e7, 1e5, -1e9), Vec3(4e4, -2e7, -1e9)}) {
    scene.lenses.push_back({1, scene.camera.position + scene.camera.axes.parent_from_local(p)});
  }
  const auto planes = lens_planes(scene, Method::ShinotsukaMakino);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_NEAR(planes[0].sources[1].position.x, -3e7, 1e-4);
  EXPECT_NEAR(planes[0].distance, 1e9, 1e-4);
}

TEST(LensPlanes, DepthsThatDifferStayApart) {
  const auto planes =
      lens_planes(scene_with({{1, {0, 0, -1e9}}, {1, {0, 0, -1e9 * (1 + 1e-10)}}}), Method::ShinotsukaMakino);
  EXPECT_EQ(planes.size(), 2U);
}

TEST(LensPlanes, ZeroMassMakesNoPlane) {
  EXPECT_TRUE(lens_planes(scene_with({{0, {0, 0, -10}}}), Method::ShinotsukaMakino).empty());
  EXPECT_TRUE(lens_planes(scene_with({{0, {0, 0, -10}}}), Method::Kishi).empty());
}

TEST(LensPlanes, KishiPutsAllSourcesOnTheMassWeightedMeanDepth) {
  const auto planes =
      lens_planes(scene_with({{1, {5, 1, -10}}, {3, {7, 2, -20}}, {4, {9, 3, -40}}}), Method::Kishi);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_DOUBLE_EQ(planes[0].distance, (1 * 10 + 3 * 20 + 4 * 40) / 8.0);
  ASSERT_EQ(planes[0].sources.size(), 3U);
  EXPECT_EQ(planes[0].sources[1].position.x, 7);
}

TEST(LensPlanes, KishiLeavesOutSourcesBesideAndBehindTheCamera) {
  const auto planes =
      lens_planes(scene_with({{1, {0, 0, 50}}, {1, {3, 0, 0}}, {2, {0, 0, -10}}}), Method::Kishi);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_EQ(planes[0].distance, 10);
  EXPECT_EQ(planes[0].sources.size(), 1U);
}

TEST(LensPlanes, KishiMeanDepthDoesNotOverflow) {
  const auto planes =
      lens_planes(scene_with({{1e300, {0, 0, -1e300}}, {1e300, {0, 0, -1e300}}}), Method::Kishi);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_DOUBLE_EQ(planes[0].distance, 1e300);
}

}  // namespace
}  // namespace lensplane
