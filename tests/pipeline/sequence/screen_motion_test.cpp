// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/screen_motion.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/shot/shot_scene.h"
#include "src/constants.h"
#include "tests/pipeline/shot/example_shot.h"

namespace lensplane {
namespace {

constexpr double kDegree = kPi / 180;

// Of the example's camera: pixels per slope, and half of the frame.
const double kFocal = 20 / std::tan(1.5 * kDegree);
constexpr double kHalf = 20;

/// Pixels in half a frame, while the shutter is open.
double motion_with(std::vector<std::string> settings) {
  settings.push_back("camera.shutter={open: -0.25, close: 0.25}");
  return screen_motion(example_shot(settings), 1002);
}

std::string keyed(const std::string& from, const std::string& to) {
  return "{keys: {1001: " + from + ", 1003: " + to + "}}";  // 1002 is half way
}

TEST(ScreenMotion, IsNothingWhereNothingMoves) {
  EXPECT_EQ(motion_with({}), 0);
  EXPECT_EQ(motion_with({"layers.background={name: stars, type: stars, catalogue: c.csv}"}), 0);
  // However narrow the view.
  EXPECT_EQ(motion_with({"camera.fov=1e-9 deg", "camera.look_at=earth", "camera.position=[1 m, 2 m, 3 m]",
                         "layers.background={name: sky, type: latlong, image: s.exr}"}),
            0);
  // What moves with the camera stands still on the film.
  EXPECT_EQ(motion_with({"camera.rotation=" + keyed("[0 deg, 90 deg, 0 deg]", "[0 deg, 120 deg, 0 deg]")}),
            0);
  EXPECT_EQ(
      screen_motion(example_shot({"lenses.near.position=" + keyed("[0 m, 0 m, -1 m]", "[1 m, 0 m, -1 m]")}),
                    1002),
      0);  // without a shutter
}

TEST(ScreenMotion, LensesMoveByTheirSpeed) {
  // 3 pixels a frame.
  const double metres = 3 / kFocal * 4.36e8;
  const std::string ends[] = {fmt::format("[{} m, 0 m, -4.36e8 m]", -metres),
                              fmt::format("[{} m, 0 m, -4.36e8 m]", metres)};
  EXPECT_NEAR(motion_with({"lenses.near.position=" + keyed(ends[0], ends[1])}), 1.5, 1e-3);
  // A mass that grows: its circle of Einstein does, sqrt(4 m/D) with dm/m = 1/2 a frame.
  const double radius = kFocal * std::sqrt(4 * 1476.625 / 4.36e8);
  EXPECT_NEAR(motion_with({"lenses.near.mass=" + keyed("0.5 Msun", "1.5 Msun")}), radius / 4 / 2, 0.03);
}

TEST(ScreenMotion, CamerasSweepTheSkyMostAtItsEdges) {
  const std::string sky = "layers.background={name: sky, type: latlong, image: s.exr}";
  const std::string stars = "layers.background={name: stars, type: stars, catalogue: c.csv}";
  const std::string pan = "camera.rotation=" + keyed("[0 deg, -1 deg, 0 deg]", "[0 deg, 1 deg, 0 deg]");
  const double expected = 0.5 * kDegree * kFocal * (1 + kHalf * kHalf / kFocal / kFocal);
  for (const std::string& far : {sky, stars}) EXPECT_NEAR(motion_with({far, pan}), expected, 0.01 * expected);
  // Stars may turn themselves, and against the camera.
  const std::string turn =
      "layers.stars.rotation=" + keyed("[0 deg, -1 deg, 0 deg]", "[0 deg, 1 deg, 0 deg]");
  EXPECT_NEAR(motion_with({stars, turn}), expected, 0.01 * expected);
  EXPECT_NEAR(
      motion_with({stars, turn, pan, "lenses=[]", "layers.earth={name: again, type: plate, image: a.exr}"}),
      0, 1e-9);
  // A zoom moves corners.
  const double corner = std::hypot(20, 10), rate = 0.01 * kDegree / std::tan(1.5 * kDegree);
  EXPECT_NEAR(motion_with({sky, "camera.fov=" + keyed("2.96 deg", "3.04 deg")}), corner * rate,
              0.03 * corner * rate);
}

TEST(ScreenMotion, BodiesMoveGrowAndTurn) {
  const double radius = kFocal * 6.371e6 / 1.09e9;
  const double metres = 4 / kFocal * 1.09e9;
  const std::string ends[] = {fmt::format("[0 m, {} m, -1.09e9 m]", -metres / 2),
                              fmt::format("[0 m, {} m, -1.09e9 m]", metres / 2)};
  EXPECT_NEAR(motion_with({"layers.earth.centre=" + keyed(ends[0], ends[1])}), 1, 0.02);
  EXPECT_NEAR(motion_with({"layers.earth.radius=" + keyed("5371 km", "7371 km")}), 0.5 * radius * 1000 / 6371,
              0.02);
  // Turning: the middle of the globe is the fastest. The same for the edge of its night.
  const std::string angles = keyed("[0 deg, -40 deg, 0 deg]", "[0 deg, 40 deg, 0 deg]");
  const double turning = 0.5 * radius * 40 * kDegree;
  EXPECT_NEAR(motion_with({"layers.earth.rotation=" + angles}), turning, 0.03 * turning);
  EXPECT_NEAR(motion_with({"layers.earth.light=" + keyed("[1, 0, 0]", "[0, 0, 1]")}),
              0.5 * radius * 45 * kDegree, 0.03 * turning);
  // A ring that tips over, seen from its side, moves by its outer radius.
  const std::string ring =
      "{name: ring, type: ring, centre: earth, inner: 8e6 m, outer: 1e7 m, image: r.png, normal: " +
      keyed("[0, 1, 0.1]", "[0, 1, -0.1]") + "}";
  const double tipping = 0.5 * kFocal * 1e7 / 1.09e9 * std::atan(0.1);
  EXPECT_NEAR(motion_with({"layers.background=" + ring}), tipping, 0.05 * tipping);
}

TEST(ScreenMotion, WhatIsNotInTheFrameDoesNotCount) {
  EXPECT_EQ(motion_with({"layers.earth.centre=" + keyed("[1e9 m, 0 m, -1e9 m]", "[2e9 m, 0 m, -1e9 m]")}), 0);
  EXPECT_EQ(motion_with({"layers.earth.centre=" + keyed("[0 m, 0 m, 1e9 m]", "[1e8 m, 0 m, 1e9 m]")}), 0);
}

TEST(ScreenMotion, OfALatLongGoesTheShorterWayRoundTheSeam) {
  const std::string sky = "layers.background={name: sky, type: latlong, image: s.exr}";
  const std::string camera = "camera={projection: latlong, resolution: [360, 180], rotation: " +
                             keyed("[0 deg, -1 deg, 0 deg]", "[0 deg, 1 deg, 0 deg]") + "}";
  EXPECT_NEAR(motion_with({camera, sky, "layers.earth={name: again, type: plate, image: a.exr}", "lenses=[]",
                           "trace.method=planes"}),
              0.5, 1e-6);
}

}  // namespace
}  // namespace lensplane
