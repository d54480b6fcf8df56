// SPDX-License-Identifier: Apache-2.0
//
// What whole shots look like, held against other programs and against the textures that they show.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/end_to_end/read_picture.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

/// A smooth plate: single waves across the frame, so that filters of different widths agree.
void write_smooth_plate(const std::filesystem::path& path, int width, int height) {
  OIIO::ImageBuf plate(OIIO::ImageSpec(width, height, 4, OIIO::TypeDesc::FLOAT));
  for (OIIO::ImageBuf::Iterator<float> p(plate); !p.done(); ++p) {
    const double s = (p.x() + 0.5) / width, t = 1 - (p.y() + 0.5) / height;
    p[0] = static_cast<float>(0.5 + 0.3 * std::sin(6.3 * s));
    p[1] = static_cast<float>(0.5 + 0.3 * std::cos(6.3 * t));
    p[2] = static_cast<float>(0.2 + 0.5 * s * t);
    p[3] = 1;
  }
  ASSERT_TRUE(plate.write(path.string()));
}

// Ours is filtered by a Gaussian, st_warp filters its own way; on a smooth plate both are the same.
constexpr double kStWarpError = 1e-3;

TEST(Picture, OiiotoolAppliesOurMapAsWeDo) {
  const TemporaryFolder folder;
  write_smooth_plate(folder / "plate.exr", 400, 300);
  const auto shot = folder.write("warp.yaml", R"(lensplane: 1
shot: warp
frames: 1
camera: {resolution: [400, 300], fov: 40 deg}
lenses:
  - {name: a, radius: 2 m, position: [20 m, 10 m, -100 m]}
  - {name: b, radius: 3 m, position: [-25 m, -15 m, -150 m]}
layers:
  - {name: bg, type: plate, image: {file: plate.exr, space: ACEScg}}
trace: {method: shinotsuka-makino}
output: {directory: ., image: {type: float}}
)");
  const ProgramResult ours = lensplane({"render", shot.string(), "--quiet"});
  ASSERT_EQ(ours.exit_code, 0) << ours.err;
  const ProgramResult theirs =
      run_program({"oiiotool", (folder / "plate.exr").string(), (folder / "warp.bg.map.0001.exr").string(),
                   "--st_warp:filter=triangle:flip_t=1", "-o", (folder / "st_warp.exr").string()});
  ASSERT_EQ(theirs.exit_code, 0) << theirs.err;

  const OIIO::ImageBuf a = read_picture(folder / "warp.0001.exr"), b = read_picture(folder / "st_warp.exr"),
                       map = read_picture(folder / "warp.bg.map.0001.exr");
  int compared = 0;
  double moved = 0;
  for (int y = 1; y < 299; ++y) {
    for (int x = 1; x < 399; ++x) {
      // Away from the plate's edges, and from where the map is so steep that the area of a pixel matters.
      const double s = map.getchannel(x, y, 0, 0), t = map.getchannel(x, y, 0, 1);
      const bool inside = s > 0.02 && s < 0.98 && t > 0.02 && t < 0.98;
      const auto across = [&](int c) {
        return map.getchannel(x + 1, y, 0, c) - map.getchannel(x - 1, y, 0, c);
      };
      const auto down = [&](int c) {
        return map.getchannel(x, y + 1, 0, c) - map.getchannel(x, y - 1, 0, c);
      };
      const double steep = std::hypot(across(0), down(0)) * 400 + std::hypot(across(1), down(1)) * 300;
      if (!inside || steep > 8) continue;
      ++compared;
      moved = std::max(moved, std::abs(s - (x + 0.5) / 400));
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(a.getchannel(x, y, 0, c), b.getchannel(x, y, 0, c), kStWarpError) << x << " " << y;
    }
  }
  EXPECT_GT(compared, 75000);  // five eighths of the frame less the edges
  EXPECT_GT(moved * 400, 10);  // pixels: there is something to compare
}

/// The colour of the texture at a longitude and latitude, in degrees, as stored.
std::array<float, 3> texture_at(const OIIO::ImageBuf& texture, double longitude, double latitude) {
  std::array<float, 3> colour{};
  const double x = (longitude / 360 + 0.5) * texture.spec().width;
  const double y = (0.5 - latitude / 180) * texture.spec().height;
  texture.interppixel(static_cast<float>(x), static_cast<float>(y), colour.data());
  return colour;
}

struct Landmark {
  const char* what;
  double longitude;
  double latitude;
};

/// The Earth seen from far away without lenses, its texture shown as it is: every landmark lies where the map
/// of the Earth has it, east to the right, north up.
TEST(Picture, EarthIsTheRightWayRound) {
  const TemporaryFolder folder;
  const auto shot = folder.write("earth.yaml", R"(lensplane: 1
shot: earth
frames: 1-3
camera: {resolution: [401, 401], fov: 2 deg}
layers:
  - name: earth
    type: sphere
    centre: [0 m, 0 m, -1000 m]
    radius: 15 m
    rotation: {keys: {1: [0 deg, 0 deg, 0 deg], 2: [0 deg, -80 deg, 0 deg], 3: [30 deg, 100 deg, 0 deg]}, interpolate: step}
    image: {file: lensplane:textures/earth_day.jpg, space: ACEScg}
trace: {method: kishi}
output: {directory: ., image: {type: float}, review: none}
)");
  ASSERT_EQ(lensplane({"render", shot.string(), "--quiet"}).err, "");
  const OIIO::ImageBuf texture = read_picture(LENSPLANE_SOURCE_DIR "/textures/earth_day.jpg");
  const double degree = std::acos(-1.0) / 180;
  // Frame, tilt about x, turn about y.
  const std::array<std::array<double, 3>, 3> views = {{{1, 0, 0}, {2, 0, -80}, {3, 30, 100}}};
  const Landmark landmarks[] = {{"Sahara", 10, 23},         {"Congo", 22, 0},    {"Atlantic", -20, 0},
                                {"India", 78, 20},          {"Arabia", 48, 22},  {"South Pole", 0, -89.9},
                                {"Greenland", -40, 72},     {"Brazil", -55, -8}, {"Indian Ocean", 80, -10},
                                {"Madagascar", 46.5, -19.5}};
  int seen = 0;
  for (const auto& [frame, tilt, turn] : views) {
    const OIIO::ImageBuf picture =
        read_picture(folder / ("earth.000" + std::to_string(static_cast<int>(frame)) + ".exr"));
    for (const Landmark& place : landmarks) {
      // The place on a unit globe, longitude 0 towards +z, then tilted about x and turned about y.
      const double lon = place.longitude * degree, lat = place.latitude * degree, a = tilt * degree,
                   b = turn * degree;
      const double x0 = std::sin(lon) * std::cos(lat), y0 = std::sin(lat), z0 = std::cos(lon) * std::cos(lat);
      const double y1 = y0 * std::cos(a) - z0 * std::sin(a), z1 = y0 * std::sin(a) + z0 * std::cos(a);
      const double x2 = x0 * std::cos(b) + z1 * std::sin(b), z2 = z1 * std::cos(b) - x0 * std::sin(b);
      if (z2 < 0.35) continue;  // on the far side, or too near the limb
      const double slope = 401 / (2 * std::tan(degree));
      const double px = 200.5 + slope * 15 * x2 / (1000 - 15 * z2),
                   py = 200.5 - slope * 15 * y1 / (1000 - 15 * z2);
      std::array<float, 4> got{};
      picture.interppixel(static_cast<float>(px), static_cast<float>(py), got.data());
      const auto expected = texture_at(texture, place.longitude, place.latitude);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(got[c], expected[c], 0.12) << place.what << " frame " << frame;
      ++seen;
    }
  }
  EXPECT_GE(seen, 12);
}

TEST(Picture, SkyLooksWhereTheContractSays) {
  // A sky of four colours: behind (red), left (green), ahead (blue), right (white).
  const TemporaryFolder folder;
  OIIO::ImageBuf sky(OIIO::ImageSpec(400, 200, 3, OIIO::TypeDesc::FLOAT));
  for (OIIO::ImageBuf::Iterator<float> p(sky); !p.done(); ++p) {
    const double s = (p.x() + 0.5) / 400;
    const bool left = s > 0.125 && s<0.375, ahead = s> 0.375 && s<0.625, right = s> 0.625 && s < 0.875;
    p[0] = !left && !ahead;
    p[1] = left || right;
    p[2] = ahead || right;
  }
  ASSERT_TRUE(sky.write((folder / "sky.exr").string()));
  const auto shot = folder.write("sky.yaml", R"(lensplane: 1
shot: sky
frames: 1-4
camera:
  resolution: [9, 9]
  fov: 20 deg
  rotation: {keys: {1: [0 deg, 0 deg, 0 deg], 2: [0 deg, 90 deg, 0 deg], 3: [0 deg, 180 deg, 0 deg], 4: [0 deg, -90 deg, 0 deg]}}
layers: [{name: sky, type: latlong, image: sky.exr}]
trace: {method: kishi}
output: {directory: ., image: {type: float}, review: none}
)");
  ASSERT_EQ(lensplane({"render", shot.string(), "--quiet"}).err, "");
  const float expected[4][3] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}};  // ahead, left, behind, right
  for (int frame = 1; frame <= 4; ++frame) {
    const OIIO::ImageBuf picture = read_picture(folder / ("sky.000" + std::to_string(frame) + ".exr"));
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(picture.getchannel(4, 4, 0, c), expected[frame - 1][c], 1e-5) << frame;
  }
}

TEST(Picture, PlateSequencesAreReadFrameByFrame) {
  const TemporaryFolder folder;
  for (int frame = 5; frame <= 6; ++frame) {
    OIIO::ImageBuf plate(OIIO::ImageSpec(8, 8, 3, OIIO::TypeDesc::FLOAT));
    for (OIIO::ImageBuf::Iterator<float> p(plate); !p.done(); ++p)
      p[0] = p[1] = p[2] = static_cast<float>(frame) / 10;
    ASSERT_TRUE(plate.write((folder / ("bg.000" + std::to_string(frame) + ".exr")).string()));
  }
  const auto shot = folder.write("plate.yaml", R"(lensplane: 1
shot: plate
frames: 5-7
camera: {resolution: [8, 8], fov: 20 deg}
layers: [{name: bg, type: plate, image: bg.####.exr}]
trace: {method: kishi}
output: {directory: out, image: {type: float}}
)");
  EXPECT_EQ(lensplane({"render", shot.string(), "-f", "5-6", "--quiet"}).err, "");
  EXPECT_NEAR(read_picture(folder / "out/plate.0005.exr").getchannel(4, 4, 0, 0), 0.5, 1e-6);
  EXPECT_NEAR(read_picture(folder / "out/plate.0006.exr").getchannel(4, 4, 0, 0), 0.6, 1e-6);
  const ProgramResult hole = lensplane({"render", shot.string(), "--quiet"});
  EXPECT_EQ(hole.exit_code, 2);
  EXPECT_EQ(hole.err, shot.string() + ":5:41: layers.bg.image: " + (folder / "bg.0007.exr").string() +
                          ": no such image\n");
}

TEST(Picture, FrameBesideOneThatFailsIsWhole) {
  // Two frames are in the making at once; the second has no plate.
  const TemporaryFolder folder;
  write_smooth_plate(folder / "bg.0001.exr", 64, 64);
  const auto shot = folder.write("beside.yaml", R"(lensplane: 1
shot: beside
frames: 1-2
camera: {resolution: [1500, 1000], fov: 20 deg}
layers: [{name: bg, type: plate, image: bg.####.exr}]
trace: {method: kishi}
output: {directory: out}
)");
  EXPECT_EQ(lensplane({"render", shot.string(), "--quiet", "--threads", "2"}).exit_code, 2);
  const OIIO::ImageBuf picture = read_picture(folder / "out/beside.0001.exr"),
                       map = read_picture(folder / "out/beside.bg.map.0001.exr");
  for (int y = 0; y < 1000; y += 37) {
    for (int x = 0; x < 1500; x += 41) {
      ASSERT_EQ(map.getchannel(x, y, 0, 2), 1.0F);
      ASSERT_GT(picture.getchannel(x, y, 0, 1), 0.1F);
    }
  }
}

}  // namespace
}  // namespace lensplane
