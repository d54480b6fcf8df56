// SPDX-License-Identifier: Apache-2.0

#include "src/lens_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// `p` moved by one bit in every coordinate.
Vec3 one_bit_from(const Vec3& p, double towards) {
  return {std::nextafter(p.x, towards), std::nextafter(p.y, towards), std::nextafter(p.z, towards)};
}

/// All sources of `lenses` in the order of the planes, the same for every order of the lenses.
std::vector<Source> sources_in_any_order(std::vector<Lens> lenses, Projection projection) {
  std::vector<Source> sources;
  const auto by_z = [](const Lens& a, const Lens& b) { return a.position.z < b.position.z; };
  std::sort(lenses.begin(), lenses.end(), by_z);
  for (bool first = true; first || std::next_permutation(lenses.begin(), lenses.end(), by_z); first = false) {
    Scene scene = scene_with(lenses);
    scene.camera.projection = projection;
    std::vector<Source> here;
    for (const LensPlane& plane : lens_planes(scene, Method::Planes)) {
      here.insert(here.end(), plane.sources.begin(), plane.sources.end());
    }
    if (first) sources = here;
    EXPECT_EQ(here.size(), sources.size());
    for (std::size_t i = 0; i < std::min(here.size(), sources.size()); ++i) {
      EXPECT_EQ(here[i].m, sources[i].m);
      EXPECT_EQ(here[i].position, sources[i].position);
    }
  }
  return sources;
}

TEST(LensPlanes, SourcesOneBitApartAreOneBodyInAnyOrderAndView) {
  const Vec3 place(2e8, -3e8, -1e9), beside(2e8, 4e8, -1e9 * (1 + 1e-15));
  for (const Projection projection : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    for (const double m : {1e-9, 1.0, 1e4}) {  // the light ones' horizons are much smaller than the bit
      for (const double towards : {-kInfinity, 0.0, kInfinity}) {
        // Between the two in the order of x, y and z stands one that has nothing to do with them.
        const auto sources =
            sources_in_any_order({{m, place}, {m, one_bit_from(place, towards)}, {m, beside}}, projection);
        ASSERT_EQ(sources.size(), 2U) << m << " " << towards;
        const Source& body = sources[sources[0].m < sources[1].m ? 1 : 0];
        EXPECT_EQ(body.m, 2 * m);
        EXPECT_LE((body.position - place).length(), 4e-16 * place.length());
      }
    }
  }
}

TEST(LensPlanes, SourcesWithinAShareOfTheirMassAreOneBodyAcrossPlanes) {
  for (const Projection projection : {Projection::Perspective, Projection::LatLong}) {
    const auto at_depth = [&](double apart) {
      return sources_in_any_order({{1, {0, 0, -100}}, {3, {0, 0, -100 - apart}}}, projection);
    };
    const auto one = at_depth(0.9 * kOneBody * 4);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_DOUBLE_EQ(one[0].position.z, -100 - 0.75 * 0.9 * kOneBody * 4);
    EXPECT_EQ(at_depth(1.1 * kOneBody * 4).size(), 2U);
  }
}

TEST(LensPlanes, AnInfiniteMassTakesInTheOthersWhereItIs) {
  const Vec3 place(3, 4, -1e9);
  for (const Projection projection : {Projection::Perspective, Projection::LatLong}) {
    const auto sources =
        sources_in_any_order({{1, {0, 0, -10}}, {kInfinity, place}, {2, {9, 9, 9}}}, projection);
    ASSERT_EQ(sources.size(), 1U);
    EXPECT_EQ(sources[0].m, kInfinity);
    EXPECT_EQ(sources[0].position, place);
    const auto two = sources_in_any_order({{kInfinity, {0, 0, -10}}, {kInfinity, place}}, projection);
    ASSERT_EQ(two.size(), 1U);
    EXPECT_TRUE(two[0].position == place || two[0].position == Vec3(0, 0, -10));
  }
}

}  // namespace
}  // namespace lensplane
