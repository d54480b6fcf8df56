// SPDX-License-Identifier: Apache-2.0
//
// lensplane export, and shots whose camera comes from such files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/read_picture.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

/// The Earth behind a mass, seen by `camera`.
std::string shot_of(const std::string& camera) {
  return "lensplane: 1\nshot: moved\nframes: 1-2\ncamera: {resolution: [60, 40], " + camera + R"(}
lenses: [{name: near, mass: 1.989e31 kg, position: [0 m, 0 m, -4.36e8 m]}]
layers: [{name: earth, type: sphere, centre: [0 m, 0 m, -1.09e9 m], radius: 6371 km, image: "lensplane:textures/earth_night.jpg"}]
output: {directory: out, review: none}
)";
}

TEST(Export, ACameraThatWentThroughAFileSeesTheSame) {
  const TemporaryFolder folder;
  const auto keyed = folder.write(
      "keyed.yaml", shot_of("fov: {keys: {1: 3 deg, 2: 4 deg}}, rotation: [0 deg, 0.2 deg, 10 deg], "
                            "position: {keys: {1: [0 m, 0 m, 0 m], 2: [1e6 m, 2e6 m, 1e6 m]}}"));
  const ProgramResult exported =
      lensplane({"export", keyed.string(), "--to", "chan", "--output", folder.path().string()});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_EQ(exported.out, (folder / "moved.chan").string() + "\n");
  const auto from = folder.write("from.yaml", shot_of("from: moved.chan"));
  for (const auto& [shot, out] : {std::pair(keyed, "keyed"), std::pair(from, "from")})
    ASSERT_EQ(lensplane({"render", shot.string(), "--quiet", "--output", (folder / out).string()}).err, "");
  for (const char* name : {"moved.0001.exr", "moved.0002.exr"}) {
    const OIIO::ImageBuf a = read_picture(folder / (std::string("keyed/") + name)),
                         b = read_picture(folder / (std::string("from/") + name));
    double light = 0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 60; ++x) {
        light += a.getchannel(x, y, 0, 3);
        ASSERT_NEAR(a.getchannel(x, y, 0, 1), b.getchannel(x, y, 0, 1), 1e-3) << name << " " << x << " " << y;
      }
    }
    EXPECT_GT(light, 100);
  }
}

/// What lensplane renders is a plate that says where the camera was, moved and turned, at every frame.
TEST(Export, APlateSaysWhereItsCameraWas) {
  const TemporaryFolder folder;
  const auto keyed = folder.write(
      "keyed.yaml",
      shot_of("fov: 40 deg, rotation: {keys: {1: [5 deg, -170 deg, 30 deg], 2: [-40 deg, 150 deg, "
              "-10 deg]}}, position: {keys: {1: [7e5 m, -3e5 m, 2e5 m], 2: [1e6 m, 2e6 m, 1e6 m]}}"));
  ASSERT_EQ(lensplane({"render", keyed.string(), "--quiet"}).err, "");
  const auto from = folder.write("from.yaml", R"(lensplane: 1
shot: again
frames: 1-2
camera: {resolution: [60, 40], from: plate, fov: 40 deg}
layers: [{name: bg, type: plate, image: out/moved.####.exr}]
)");
  EXPECT_EQ(lensplane({"check", from.string()}).err, "");
  for (const auto& shot : {keyed, from})
    ASSERT_EQ(lensplane({"export", shot.string(), "--to", "chan", "--output", folder.path().string()}).err,
              "");
  std::istringstream a(contents_of(folder / "moved.chan")), b(contents_of(folder / "again.chan"));
  int numbers = 0;
  for (double of_a = 0, of_b = 0; a >> of_a && b >> of_b; ++numbers)
    EXPECT_NEAR(of_a, of_b, 1e-6 * std::max(180.0, 4 * std::abs(of_a))) << numbers;
  EXPECT_EQ(numbers, 16);
}

TEST(Export, RefusesInOneLine) {
  const TemporaryFolder folder;
  const auto from = folder.write("moved.yaml", shot_of("from: moved.chan"));
  const auto expect = [&](const std::vector<std::string>& words, int code, const std::string& reason) {
    const ProgramResult result = lensplane(words);
    EXPECT_EQ(result.exit_code, code) << reason;
    EXPECT_THAT(result.err, HasSubstr(reason));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  expect({"check", from.string()}, 2, "moved.chan: no such camera file");
  folder.write("moved.chan", "1 0 0 0 0 0 0 2\n2 0 0 O 0 0 0 2\n");
  expect({"render", from.string()}, 2, "moved.chan:2: \"O\" is no number");
  folder.write("moved.chan", "1 0 0 0 0 0 0 2\n2 0 0 0 0 0 0 2\n");
  expect({"export", from.string(), "--to", "chan", "--output", folder.path().string()}, 1,
         "moved.chan: the shot reads this file and would overwrite it");
  expect({"export", from.string(), "--to", "maya"}, 1, "--to");
  expect({"export", from.string(), "--to", "chan", "--set",
          "camera={resolution: [60, 30], projection: latlong}"},
         1, "camera.projection: .chan files are of perspective cameras only");
  folder.write("file", "");
  expect({"export", from.string(), "--to", "chan", "--output", (folder / "file").string()}, 3, "file");
  EXPECT_EQ(contents_of(folder / "moved.chan"), "1 0 0 0 0 0 0 2\n2 0 0 0 0 0 0 2\n");
}

}  // namespace
}  // namespace lensplane
