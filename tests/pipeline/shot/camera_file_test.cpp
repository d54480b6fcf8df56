// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/shot/shot_reader.h"
#include "pipeline/shot/shot_scene.h"
#include "src/constants.h"
#include "src/projection.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double kDegree = kPi / 180.0;

/// A shot of two frames whose camera says `camera` beside its size, and a file track.chan beside it.
struct Tracked {
  TemporaryFolder folder;
  std::filesystem::path file;

  Tracked(const std::string& camera, const std::string& chan) {
    folder.write("track.chan", chan);
    file = folder.write("tracked.yaml",
                        "lensplane: 1\nshot: tracked\nframes: 1-2\ncamera:\n  resolution: [200, 100]\n  " +
                            camera + "\nlayers:\n  - {name: sky, type: latlong, image: sky.exr}\n");
  }
  Shot shot() const { return read_shot(file); }
  std::string refusal() const {
    return refusal_of([&] { shot(); }).line;
  }
};

TEST(CameraFile, PutsTheCameraWhereTheFileSays) {
  const Tracked tracked("from: track.chan", "1 1 2 3 0 0 0 40\n2 5 2 3 0 90 0 40\n");
  const Camera first = scene_at(tracked.shot(), 1).camera;
  EXPECT_EQ(first.position, Vec3(1, 2, 3));
  // 20 deg above the axis lies the upper edge; a frame twice as wide as high sees twice the tangent across.
  const Vector<double> up_20_deg(0, std::sin(20 * kDegree), -std::cos(20 * kDegree));
  const auto top = *film_from_direction(first, up_20_deg);
  EXPECT_NEAR(top.x, 100, 1e-9);
  EXPECT_NEAR(top.y, 0, 1e-9);
  EXPECT_NEAR(first.fov_rad, 2 * std::atan(2 * std::tan(20 * kDegree)), 1e-12);
  // A quarter turn about y: -z goes to -x.
  const Camera second = scene_at(tracked.shot(), 2).camera;
  EXPECT_LT(length(second.axes.parent_from_local({0, 0, -1}) - Vec3(-1, 0, 0)), 1e-12);
  // Between frames, as motion blur asks.
  EXPECT_LT(length(scene_at(tracked.shot(), 1.25).camera.position - Vec3(2, 2, 3)), 1e-12);
}

TEST(CameraFile, RotatesAboutZThenXThenY) {
  const Tracked tracked("from: track.chan", "1 0 0 0 30 90 90 40\n2 0 0 0 30 90 90 40\n");
  const Basis axes = scene_at(tracked.shot(), 1).camera.axes;
  // Up: z takes +y to -x, x leaves it, y takes -x to +z.
  EXPECT_LT(length(axes.y - Vec3(0, 0, 1)), 1e-12);
  // Forward: z leaves -z, x lifts it by 30 deg, y takes it to -x.
  EXPECT_LT(length(-axes.z - Vec3(-std::cos(30 * kDegree), std::sin(30 * kDegree), 0)), 1e-12);
}

TEST(CameraFile, AnglesGoTheShorterWay) {
  const Tracked tracked("from: track.chan", "1 0 0 0 0 179 0 40\n2 0 0 0 0 -179 0 40\n");
  const Vec3 forward = scene_at(tracked.shot(), 1.5).camera.axes.parent_from_local({0, 0, -1});
  EXPECT_LT(length(forward - Vec3(0, 0, 1)), 1e-12);
}

TEST(CameraFile, UnitsAreTheShotsToSay) {
  const Tracked tracked("from: {file: track.chan, unit: 1000 km}", "1 0 0 -2 0 0 0 40\n2 0 0 -2 0 0 0 40\n");
  EXPECT_EQ(scene_at(tracked.shot(), 1).camera.position, Vec3(0, 0, -2e6));
  const Tracked with_fov("from: track.chan\n  fov: 3 deg", "1 0 0 0 0 0 0\n2 0 0 0 0 0 0\n");
  EXPECT_NEAR(scene_at(with_fov.shot(), 2).camera.fov_rad, 3 * kDegree, 1e-15);
}

TEST(CameraFile, RefusesWhatDoesNotFit) {
  const std::string good = "1 0 0 0 0 0 0 40\n2 0 0 0 0 0 0 40\n", bare = "1 0 0 0 0 0 0\n2 0 0 0 0 0 0\n";
  EXPECT_EQ(Tracked("from: track.chan", good).refusal(), "");
  EXPECT_THAT(Tracked("from: other.chan", good).refusal(), HasSubstr(":6:9: camera.from: "));
  EXPECT_THAT(Tracked("from: other.chan", good).refusal(), HasSubstr("other.chan: no such camera file"));
  EXPECT_THAT(Tracked("from: track.chan", "1 0 0 0 0 0 0 40\n").refusal(),
              HasSubstr("it has frames 1 to 1, and the shot frame 2"));
  EXPECT_THAT(Tracked("from: track.chan", bare).refusal(),
              HasSubstr("it has no field of view; needed: camera.fov"));
  EXPECT_THAT(Tracked("from: track.chan\n  fov: 3 deg", good).refusal(),
              HasSubstr("it has a field of view; allowed: no camera.fov beside it"));
  EXPECT_THAT(Tracked("from: track.chan", "1 0 0 0 0 0 0 1e-20\n2 0 0 0 0 0 0 1\n").refusal(),
              HasSubstr("frame 1: a field of view of"));
  EXPECT_THAT(
      Tracked("from: {file: track.chan, unit: 1e29 m}", "1 0 0 9e90 0 0 0 4\n2 0 0 0 0 0 0 4\n").refusal(),
      HasSubstr("m away; allowed: up to 1e+100"));
  EXPECT_THAT(Tracked("from: track.chan\n  position: [0 m, 0 m, 0 m]", good).refusal(),
              HasSubstr("camera.position: given together with from"));
  EXPECT_THAT(Tracked("from: track.chan\n  look_at: [0 m, 0 m, 0 m]", good).refusal(),
              HasSubstr("camera.look_at: given together with from"));
  EXPECT_THAT(Tracked("from: track.chan\n  projection: latlong", good).refusal(),
              HasSubstr("camera.from: given for a camera that is not perspective"));
  EXPECT_THAT(Tracked("from: {file: track.chan, unit: 0 m}", good).refusal(),
              HasSubstr("camera.from.unit: "));
  EXPECT_THAT(Tracked("from: track.fbx", good).refusal(),
              HasSubstr("allowed: the path of a .chan file, plate, or {plate: LAYER}"));
}

/// Whatever the camera does, its file says the same.
TEST(CameraFile, WhatIsWrittenIsWhatIsRead) {
  const Tracked keyed(
      "fov: {keys: {1: 30 deg, 2: 100 deg}}\n  position: {keys: {1: [1 m, 2 m, 3 m], 2: [-1e9 m, 5 m, 0 "
      "m]}}\n"
      "  rotation: {keys: {1: [20 deg, 175 deg, -40 deg], 2: [-70 deg, 200 deg, 500 deg]}}",
      "");
  const Tracked upwards("fov: 30 deg\n  rotation: [90 deg, 25 deg, 0 deg]", "");
  const Tracked looking("fov: 30 deg\n  position: [3 m, 4 m, 5 m]\n  look_at: [0 m, 1 m, -7 m]", "");
  for (const Tracked* original : {&keyed, &upwards, &looking}) {
    const Shot shot = original->shot();
    const Tracked copy("from: track.chan", chan_text(chan_of_camera(shot, shot.frames)));
    for (const int frame : shot.frames) {
      const Camera a = scene_at(shot, frame).camera, b = scene_at(copy.shot(), frame).camera;
      EXPECT_NEAR(a.fov_rad, b.fov_rad, 1e-14);
      EXPECT_EQ(a.position, b.position);
      for (auto axis : {&Basis::x, &Basis::y, &Basis::z})
        EXPECT_LT(length(a.axes.*axis - b.axes.*axis), 1e-14);
    }
  }
}

}  // namespace
}  // namespace lensplane
