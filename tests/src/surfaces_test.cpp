// SPDX-License-Identifier: Apache-2.0

#include "src/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "src/bodies.h"
#include "src/constants.h"

namespace lensplane {
namespace {

void expect_st(TextureCoordinates st, double s, double t) {
  EXPECT_NEAR(st.s, s, 1e-15);
  EXPECT_NEAR(st.t, t, 1e-15);
}

TEST(Surfaces, SkyCoordinatesAreThoseOfTheContract) {
  expect_st(st_from_sky_direction<double>({0, 0, -1}), 0.5, 0.5);
  expect_st(st_from_sky_direction<double>({1, 0, 0}), 0.75, 0.5);
  expect_st(st_from_sky_direction<double>({-1, 0, 0}), 0.25, 0.5);
  EXPECT_NEAR(st_from_sky_direction<double>({0, 1, 0}).t, 1, 1e-15);
  EXPECT_NEAR(st_from_sky_direction<double>({0, -1, 0}).t, 0, 1e-15);
}

TEST(Surfaces, SphereCoordinatesHaveLongitudeZeroInTheMiddleAndEastToTheRight) {
  expect_st(st_from_sphere_normal<double>({0, 0, 1}), 0.5, 0.5);
  expect_st(st_from_sphere_normal<double>({1, 0, 0}), 0.75,
            0.5);  // 90 deg east, to the right of a camera that looks along -z
  EXPECT_NEAR(st_from_sphere_normal<double>({0, 1, 0}).t, 1, 1e-15);
}

TEST(Surfaces, DirectionsFromCoordinatesUndoCoordinatesFromDirections) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.001, 0.999);
  for (int i = 0; i < 1000; ++i) {
    const TextureCoordinates st{unit(random), unit(random)};
    const auto sky = st_from_sky_direction(sky_direction_from_st(st) * 7.0);
    EXPECT_NEAR(sky.s, st.s, 1e-13);
    EXPECT_NEAR(sky.t, st.t, 1e-14);
    const auto sphere = st_from_sphere_normal(sphere_normal_from_st(st) * 1e-5);
    EXPECT_NEAR(sphere.s, st.s, 1e-13);
    EXPECT_NEAR(sphere.t, st.t, 1e-14);
  }
}

TEST(Surfaces, RaysEnterSpheresFromOutsideOnly) {
  const Vec3 ahead(0, 0, -1);
  EXPECT_DOUBLE_EQ(sphere_entry<double>({0, 0, 0}, ahead, {0, 0, -10}, 2), 8);
  EXPECT_DOUBLE_EQ(sphere_entry<double>({0, 0, 0}, ahead, {2, 0, -10}, 2), 10);  // grazes
  EXPECT_TRUE(std::isinf(sphere_entry<double>({0, 0, 0}, ahead, {2.001, 0, -10}, 2)));
  EXPECT_TRUE(std::isinf(sphere_entry<double>({0, 0, 0}, ahead, {0, 0, 10}, 2)));  // behind
  EXPECT_TRUE(std::isinf(sphere_entry<double>({0, 0, 0}, ahead, {0, 0, -1}, 2)));  // from inside
  EXPECT_NEAR(sphere_entry<double>({0, 0, 0}, ahead, {0, 0, -2}, 2), 0, 1e-15);    // from the surface inwards
}

TEST(Surfaces, EntryIsAccurateForASmallBallFarAway) {
  // A ball of 1 m at 1e8 m, hit 0.6 m beside its centre.
  const Vec3 direction = Vec3(0.6, 0, -1e8).normalized();
  const double expected = 1e8 * (1 + 0.5 * 0.36e-16) - 0.8;
  EXPECT_NEAR(sphere_entry<double>({0, 0, 0}, direction, {0, 0, -1e8}, 1), expected, 1e-7);
}

}  // namespace
}  // namespace lensplane
