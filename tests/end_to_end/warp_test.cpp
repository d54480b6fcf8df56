// SPDX-License-Identifier: Apache-2.0
//
// Pictures from maps on disk: lensplane warp and lensplane comp.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/end_to_end/read_picture.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

/// A smooth plate: single waves across the frame, so that filters of different widths agree.
void write_smooth_plate(const std::filesystem::path& path, int width, int height, OIIO::TypeDesc type) {
  OIIO::ImageBuf plate(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT));
  for (OIIO::ImageBuf::Iterator<float> p(plate); !p.done(); ++p) {
    const double s = (p.x() + 0.5) / width, t = 1 - (p.y() + 0.5) / height;
    p[0] = static_cast<float>(0.5 + 0.3 * std::sin(6.3 * s));
    p[1] = static_cast<float>(0.5 + 0.3 * std::cos(6.3 * t));
    p[2] = static_cast<float>(0.2 + 0.5 * s * t);
  }
  ASSERT_TRUE(plate.write(path.string(), type));
}

double largest_difference(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b) {
  EXPECT_EQ(a.roi().width(), b.roi().width());
  EXPECT_EQ(a.roi().height(), b.roi().height());
  double largest = 0;
  for (int y = a.ybegin(); y < a.yend(); ++y) {
    for (int x = a.xbegin(); x < a.xend(); ++x) {
      for (int c = 0; c < 3; ++c)
        largest = std::max(largest, double{std::abs(a.getchannel(x, y, 0, c) - b.getchannel(x, y, 0, c))});
    }
  }
  return largest;
}

constexpr const char* kShot = R"(lensplane: 1
shot: warp
frames: 1
camera: {resolution: [240, 180], fov: 40 deg, overscan: 4}
lenses:
  - {name: a, radius: 0.5 m, position: [40 m, 30 m, -100 m]}
layers:
  - {name: bg, type: plate, image: {file: plate.exr, space: ACEScg}, edge: mirror}
  - {name: ball, type: sphere, centre: [-15 m, 0 m, -80 m], radius: 12 m, image: {file: plate.exr, space: ACEScg}, light: [0.5, 0.5, 1]}
output: {directory: out, image: {type: float}, data: [jacobian, depth]}
)";

// A pixel's one lookup against the mean of its rays, on a smooth plate: the curvature of the picture within
// a pixel.
constexpr double kOneLookupError = 3e-3;

/// How many pixels differ by more than kOneLookupError.
int count_different(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b) {
  int different = 0;
  for (int y = a.ybegin(); y < a.yend(); ++y) {
    for (int x = a.xbegin(); x < a.xend(); ++x) {
      double off = 0;
      for (int c = 0; c < 4; ++c)
        off = std::max(off, double{std::abs(a.getchannel(x, y, 0, c) - b.getchannel(x, y, 0, c))});
      different += off > kOneLookupError;
    }
  }
  return different;
}

TEST(Comp, MakesFromTheMapsWhatRenderTraces) {
  const TemporaryFolder folder;
  write_smooth_plate(folder / "plate.exr", 480, 360, OIIO::TypeDesc::FLOAT);
  const auto shot = folder.write("warp.yaml", kShot);
  ASSERT_EQ(lensplane({"render", shot.string(), "--quiet"}).err, "");
  const OIIO::ImageBuf traced = read_picture(folder / "out/warp.0001.exr");
  ASSERT_EQ(lensplane({"comp", shot.string(), "--quiet"}).err, "");
  const OIIO::ImageBuf composed = read_picture(folder / "out/warp.0001.exr");
  EXPECT_EQ(composed.spec().x, -4);
  EXPECT_EQ(composed.spec().get_string_attribute("lensplane:plan"), "from maps");
  // All but the ball's limb, whose circle is some 300 pixels long, and the lens's few pixels of other images.
  const int different = count_different(traced, composed);
  EXPECT_LT(different, 900);
  EXPECT_GT(different, 0);
  EXPECT_THAT(lensplane({"comp", shot.string()}).out, HasSubstr("already done"));
  // Without depth and jacobian of the data files: by the distance of the centre, and by differences.
  for (const char* layer : {"bg", "ball"})
    std::filesystem::remove(folder / (std::string("out/warp.") + layer + ".data.0001.exr"));
  ASSERT_EQ(lensplane({"comp", shot.string(), "--quiet"}).err, "");
  EXPECT_LT(count_different(traced, read_picture(folder / "out/warp.0001.exr")), 900);
  // A map with a hole painted into it shows what is behind.
  const auto map_path = folder / "out/warp.ball.map.0001.exr";
  OIIO::ImageBuf map = read_picture(map_path);
  int painted = 0;
  for (OIIO::ImageBuf::Iterator<float> p(map); !p.done(); ++p) {
    painted += p[2] > 0;
    p[2] = 0;
  }
  EXPECT_GT(painted, 3000);
  ASSERT_TRUE(map.write(map_path.string(), OIIO::TypeDesc::FLOAT));
  ASSERT_EQ(lensplane({"comp", shot.string(), "--quiet", "--set", "output.review=none"}).err, "");
  EXPECT_GT(count_different(traced, read_picture(folder / "out/warp.0001.exr")), painted / 2);
  // Render knows that this is not its picture.
  EXPECT_THAT(lensplane({"render", shot.string()}).out, testing::Not(HasSubstr("already done")));
}

TEST(Comp, SaysWhichMapIsMissingOrOfAnotherSize) {
  const TemporaryFolder folder;
  write_smooth_plate(folder / "plate.exr", 48, 36, OIIO::TypeDesc::FLOAT);
  const auto shot = folder.write("warp.yaml", kShot);
  const ProgramResult missing = lensplane({"comp", shot.string()});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err, (folder / "out/warp.bg.map.0001.exr").string() + ": no such map; lensplane map " +
                             shot.string() + " makes it\n");
  ASSERT_EQ(lensplane({"map", shot.string(), "--quiet", "--set", "camera.resolution=[40, 30]"}).err, "");
  const ProgramResult other = lensplane({"comp", shot.string()});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("a map of 48 x 38 pixels from (-4, -4); the shot's camera has 248 x 188"));
}

/// A foreign map that shows a picture as it is.
void write_identity(const std::filesystem::path& path, int width, int height, bool origin_on_top,
                    OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(width, height, 2, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G"};
  OIIO::ImageBuf map(spec);
  for (OIIO::ImageBuf::Iterator<float> p(map); !p.done(); ++p) {
    const double down = (p.y() + 0.5) / height;
    p[0] = static_cast<float>((p.x() + 0.5) / width);
    p[1] = static_cast<float>(origin_on_top ? down : 1 - down);
  }
  ASSERT_TRUE(map.write(path.string(), type));
}

TEST(Warp, IdentityGivesTheImageBackInItsOwnColours) {
  const TemporaryFolder folder;
  write_identity(folder / "map.exr", 60, 40, false, OIIO::TypeDesc::FLOAT);
  for (const char* name : {"image.png", "image.tif", "image.exr"}) {
    const bool exr = std::string(name) == "image.exr";
    write_smooth_plate(folder / name, 60, 40, exr ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT16);
    for (const char* filter : {"footprint", "none"}) {
      const auto out = folder / (std::string(filter) + name);
      ASSERT_EQ(lensplane({"warp", (folder / "map.exr").string(), (folder / name).string(), out.string(),
                           "--filter", filter})
                    .err,
                "");
      EXPECT_LT(largest_difference(read_picture(folder / name), read_picture(out)), exr ? 1e-5 : 3.0 / 65535)
          << name << " " << filter;
    }
  }
  EXPECT_EQ(read_picture(folder / "noneimage.exr").spec().get_string_attribute("colorInteropID"),
            "lin_ap1_scene");
}

TEST(Warp, TheOriginMayLieOnTopAndHalfMapsAreWarnedOf) {
  const TemporaryFolder folder;
  write_smooth_plate(folder / "image.exr", 60, 40, OIIO::TypeDesc::FLOAT);
  write_identity(folder / "map.exr", 60, 40, true, OIIO::TypeDesc::HALF);
  const std::vector<std::string> words = {"warp", (folder / "map.exr").string(),
                                          (folder / "image.exr").string(), (folder / "out.exr").string()};
  std::vector<std::string> top = words;
  top.insert(top.end(), {"--origin", "top", "--edge", "clamp"});
  const ProgramResult result = lensplane(top);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("map.exr: its coordinates are half floats"));
  EXPECT_LT(largest_difference(read_picture(folder / "image.exr"), read_picture(folder / "out.exr")), 5e-3);
  lensplane(words);
  EXPECT_GT(largest_difference(read_picture(folder / "image.exr"), read_picture(folder / "out.exr")), 0.1);
}

/// Our own map and data file applied by warp: what oiiotool makes with the map.
TEST(Warp, AppliesOurMapsAsOiiotoolDoes) {
  const TemporaryFolder folder;
  write_smooth_plate(folder / "plate.exr", 240, 180, OIIO::TypeDesc::FLOAT);
  const auto shot = folder.write("warp.yaml", kShot);
  ASSERT_EQ(lensplane({"map", shot.string(), "--quiet", "--set", "camera.overscan=0"}).err, "");
  const std::string map = (folder / "out/warp.bg.map.0001.exr").string(),
                    image = (folder / "plate.exr").string(), out = (folder / "ours.exr").string();
  ASSERT_EQ(lensplane({"warp", map, image, out, "--edge", "mirror"}).err, "");
  ASSERT_EQ(run_program({"oiiotool", image, map, "--st_warp:filter=triangle:flip_t=1", "-o",
                         (folder / "theirs.exr").string()})
                .exit_code,
            0);
  const OIIO::ImageBuf ours = read_picture(out), theirs = read_picture(folder / "theirs.exr"),
                       st = read_picture(map);
  int compared = 0;
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 240; ++x) {
      const double s = st.getchannel(x, y, 0, 0), t = st.getchannel(x, y, 0, 1);
      if (s < 0.02 || s > 0.98 || t < 0.02 || t > 0.98) continue;
      ++compared;
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(ours.getchannel(x, y, 0, c), theirs.getchannel(x, y, 0, c), 3e-3) << x << " " << y;
    }
  }
  EXPECT_GT(compared, 30000);
}

TEST(Warp, RefusesInOneLine) {
  const TemporaryFolder folder;
  write_smooth_plate(folder / "image.exr", 60, 40, OIIO::TypeDesc::FLOAT);
  write_identity(folder / "map.exr", 60, 40, false, OIIO::TypeDesc::FLOAT);
  const std::string map = (folder / "map.exr").string(), image = (folder / "image.exr").string();
  const auto expect = [&](std::vector<std::string> words, int code, const std::string& line) {
    words.insert(words.begin(), "warp");
    const ProgramResult result = lensplane(words);
    EXPECT_EQ(result.exit_code, code) << line;
    EXPECT_THAT(result.err, HasSubstr(line));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  };
  expect({map, image, "out.jpg"}, 1, "out.jpg: allowed: a name that ends in .exr, .png or .tif");
  expect({map, image, image}, 1, "image.exr: warp reads this file and would overwrite it");
  expect({"none.exr", image, "out.exr"}, 2, "none.exr: no such map");
  expect({map, "none.exr", "out.exr"}, 2, "none.exr: no such image");
  expect({map, image, "out.exr", "--data", image}, 2, "image.exr: it has no jacobian.ds_dx");
  expect({map, image, "out.exr", "--space", "Moon"}, 1, "--space: \"Moon\" is no colour space");
  expect({map, image, "out.exr", "--origin", "left"}, 1, "--origin");
}

}  // namespace
}  // namespace lensplane
