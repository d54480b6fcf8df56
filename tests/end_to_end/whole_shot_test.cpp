// SPDX-License-Identifier: Apache-2.0
//
// A small shot with everything in it: stars, a ring with a shadow, a card, a night, a shutter and a glow.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/read_picture.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::Not;

// Half floats, and edges.
constexpr double kPictureError = 2e-3;

// Of a frame's light between a picture by rays and one by maps.
constexpr double kMapsLightError = 0.02;

const char* const kWholeShot = R"(lensplane: 1
shot: whole
frames: 1
camera:
  resolution: [80, 60]
  fov: 20 deg
  glow: {strength: 0.1, radius: 10 %}
  shutter: {open: -0.25, close: 0.25, samples: 4}
lenses:
  - {name: hole, radius: 500 km, position: [-40000 km, 0 km, -400000 km]}
layers:
  - {name: stars, type: stars, catalogue: stars.csv, exposure: 1}
  - name: planet
    type: sphere
    centre: {keys: {0: [18000 km, 0 km, -500000 km], 2: [26000 km, 0 km, -500000 km]}}
    radius: 20000 km
    image: {file: day.exr, space: ACEScg}
    night: {file: night.exr, space: ACEScg}
    light: [1, 0.2, 0.1]
  - name: ring
    type: ring
    centre: planet
    normal: [-0.2, 1, 0.5]
    inner: 26000 km
    outer: 45000 km
    image: {file: ring.exr, space: ACEScg}
    shadow_of: planet
  - name: glass
    type: plate
    distance: 200000 km
    image: {file: glass.exr, space: ACEScg}
trace: {tolerance: 0.1 px}
output: {directory: out, image: {type: float}, review: none}
)";

/// A picture by its colour at (column, row).
void write_picture(const std::filesystem::path& path, int width, int height,
                   const std::function<std::array<float, 4>(int, int)>& colour) {
  OIIO::ImageBuf image(OIIO::ImageSpec(width, height, 4, OIIO::TypeDesc::FLOAT));
  for (OIIO::ImageBuf::Iterator<float> p(image); !p.done(); ++p) {
    const auto rgba = colour(p.x(), p.y());
    for (int c = 0; c < 4; ++c) p[c] = rgba[static_cast<std::size_t>(c)];
  }
  ASSERT_TRUE(image.write(path.string()));
}

void write_flat(const std::filesystem::path& path, std::array<float, 4> colour) {
  write_picture(path, 16, 8, [&](int, int) { return colour; });
}

/// The shot's files; its stars are three on the left of the picture, of V = 1.
std::string write_shot(const TemporaryFolder& folder) {
  write_flat(folder / "day.exr", {0.8F, 0.6F, 0.4F, 1});
  write_flat(folder / "night.exr", {0, 0, 0.3F, 1});
  write_flat(folder / "ring.exr", {0.5F, 0.5F, 0.5F, 0.75F});
  // Clear, but for its upper fifth, which is half transparent.
  write_picture(folder / "glass.exr", 40, 30, [](int, int row) {
    return row < 6 ? std::array{0.1F, 0.2F, 0.0F, 0.5F} : std::array{0.0F, 0.0F, 0.0F, 0.0F};
  });
  folder.write("stars.csv", "ra_deg,dec_deg,v_mag,b_minus_v\n4,-4,1,0.6\n7,-2,1,0.6\n8,3,1,0.6\n");
  return folder.write("whole.yaml", kWholeShot).string();
}

/// All light of a channel.
double light_of(const OIIO::ImageBuf& image, int channel) {
  double light = 0;
  for (int y = 0; y < image.spec().height; ++y) {
    for (int x = 0; x < image.spec().width; ++x)
      light += static_cast<double>(image.getchannel(x, y, 0, channel));
  }
  return light;
}

/// The picture with settings over the shot's.
OIIO::ImageBuf rendered(const TemporaryFolder& folder, const std::string& shot,
                        const std::vector<std::string>& settings) {
  std::vector<std::string> words = {"render", shot, "--quiet", "--output", (folder / "other").string()};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  const ProgramResult result = lensplane(words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return read_picture(folder / "other/whole.0001.exr");
}

TEST(WholeShot, RendersWithEveryPartSeen) {
  const TemporaryFolder folder;
  const std::string shot = write_shot(folder);
  const ProgramResult result = lensplane({"render", shot});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const OIIO::ImageBuf picture = read_picture(folder / "out/whole.0001.exr");
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      for (int c = 0; c < 4; ++c) {
        const float value = picture.getchannel(x, y, 0, c);
        ASSERT_TRUE(std::isfinite(value) && value > -1e-6F) << x << " " << y;
      }
      ASSERT_LE(picture.getchannel(x, y, 0, 3), 1.00001F);
    }
  }
  // Each part taken away, its light or its shadow goes with it.
  const double red = light_of(picture, 0), blue = light_of(picture, 2);
  EXPECT_GT(red, 10);
  const auto without = [&](const std::string& setting) { return rendered(folder, shot, {setting}); };
  EXPECT_LT(light_of(without("layers.stars.exposure=-20"), 0), red - 5);
  EXPECT_NEAR(light_of(without("layers.planet.night=null"), 0) / red, 1, kPictureError);
  EXPECT_LT(light_of(without("layers.planet.night=null"), 2), blue - 5);
  EXPECT_GT(light_of(without("layers.ring.shadow_of=null"), 0), red + 5);
  EXPECT_LT(light_of(without("layers.ring.image={file: glass.exr, space: ACEScg}"), 0), red - 5);
  // Glow moves light and leaves alpha: a corner that is black is so no more.
  const OIIO::ImageBuf clear = without("camera.glow=null");
  EXPECT_EQ(clear.getchannel(2, 57, 0, 0), 0);
  EXPECT_GT(picture.getchannel(2, 57, 0, 0), 1e-5F);
  // The card: half transparent over nothing in the upper corner.
  const std::array expected = {0.1F, 0.2F, 0.0F, 0.5F};
  for (int c = 0; c < 4; ++c) {
    EXPECT_NEAR(clear.getchannel(75, 4, 0, c), expected[static_cast<std::size_t>(c)], kPictureError);
  }
}

TEST(WholeShot, AnExposureIsTheMeanOfItsMoments) {
  const TemporaryFolder folder;
  const std::string shot = write_shot(folder);
  // By the middles of four parts of half a frame, each rendered as a shot that stands still.
  const std::vector<std::string> plain = {"camera.glow=null", "layers.stars.exposure=0"};
  std::vector<std::string> settings = plain;
  const OIIO::ImageBuf exposure = rendered(folder, shot, settings);
  std::vector<OIIO::ImageBuf> moments;
  for (const double time : {0.8125, 0.9375, 1.0625, 1.1875}) {
    settings = plain;
    settings.push_back("camera.shutter.samples=1");
    settings.push_back("layers.planet.centre=[" + std::to_string(18000 + 4000 * time) +
                       " km, 0 km, -500000 km]");
    moments.push_back(rendered(folder, shot, settings));
  }
  double worst = 0, sum = 0, moved = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      double mean = 0;
      for (const OIIO::ImageBuf& moment : moments) mean += moment.getchannel(x, y, 0, 0) / 4.0;
      const double off = std::abs(mean - static_cast<double>(exposure.getchannel(x, y, 0, 0)));
      worst = std::max(worst, off), sum += off;
      moved += std::abs(moments[0].getchannel(x, y, 0, 0) - moments[3].getchannel(x, y, 0, 0));
    }
  }
  // Moments have fewer rays on their edges, and no others.
  EXPECT_LT(worst, 0.06);
  EXPECT_LT(sum / 4800, kPictureError);
  EXPECT_GT(moved / 4800, 2 * kPictureError);
}

TEST(WholeShot, IsMadeAnewForWhateverChangesThePicture) {
  const TemporaryFolder folder;
  const std::string shot = write_shot(folder);
  ASSERT_EQ(lensplane({"render", shot}).exit_code, 0);
  EXPECT_THAT(lensplane({"render", shot}).out, HasSubstr("0001: already done"));
  for (const char* change :
       {"sampling.max=16", "sampling.threshold=0.01", "camera.shutter.samples=3", "camera.shutter.close=0.5",
        "camera.glow.strength=0.2", "layers.planet.light=[1, 0.2, 0.2]", "layers.stars.exposure=1.5",
        "layers.stars.rotation=[0 deg, 1 deg, 0 deg]", "layers.ring.light=[1, 0, 0]",
        "layers.planet.night={file: day.exr, space: ACEScg}"}) {
    const ProgramResult changed = lensplane({"render", shot, "--set", change});
    EXPECT_EQ(changed.exit_code, 0) << change << changed.err;
    EXPECT_THAT(changed.out, Not(HasSubstr("already done"))) << change;
  }
  // Back, and with another catalogue in the same file.
  EXPECT_THAT(lensplane({"render", shot}).out, Not(HasSubstr("already done")));
  EXPECT_THAT(lensplane({"render", shot}).out, HasSubstr("already done"));
  folder.write("stars.csv", "ra_deg,dec_deg,v_mag,b_minus_v\n4,-4,1.5,0.6\n");
  EXPECT_THAT(lensplane({"render", shot}).out, Not(HasSubstr("already done")));
}

TEST(WholeShot, CompDrawsStarsAndHidesThem) {
  const TemporaryFolder folder;
  const std::string shot = write_shot(folder);
  const std::vector<std::string> plain = {"--set", "camera.shutter.samples=1",
                                          "--set", "camera.glow=null",
                                          "--set", "output.data=[jacobian, depth]"};
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.end(), plain.begin(), plain.end());
    const ProgramResult result = lensplane(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_picture(folder / "out/whole.0001.exr");
  };
  const OIIO::ImageBuf by_rays = run({"render", shot});
  const OIIO::ImageBuf by_maps = run({"comp", shot, "--redo"});
  const OIIO::ImageBuf dark = run({"comp", shot, "--redo", "--set", "layers.stars.exposure=-20"});
  const double stars = light_of(by_maps, 0) - light_of(dark, 0);
  // Three stars of V = 1 and a stop: 32 times 10^-0.4 each at least, and what the lens adds.
  EXPECT_GT(stars, 3 * 32 * std::pow(10.0, -0.4) * 0.9);
  EXPECT_NEAR(light_of(by_maps, 0) / light_of(by_rays, 0), 1, kMapsLightError);
  // A sphere before everything leaves none of them.
  const auto hidden = [&](const std::string& exposure) {
    return light_of(run({"render", shot, "--set", "layers.stars.exposure=" + exposure, "--set",
                         "layers.planet.centre=[0 km, 0 km, -24000 km]"}),
                    0);
  };
  EXPECT_EQ(hidden("1"), hidden("-20"));
}

TEST(WholeShot, PixelsThatAreNoNumbersAreReported) {
  const TemporaryFolder folder;
  const std::string shot = write_shot(folder);
  const std::string stats = (folder / "stats.json").string();
  const auto replaced = [&](const std::string& expected_line) {
    const ProgramResult result = lensplane({"render", shot, "--redo", "--stats", stats});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr(expected_line));
    return nlohmann::json::parse(contents_of(stats))["frames"][0]["replaced_pixels"];
  };
  EXPECT_EQ(replaced("0001: "), nlohmann::json::object());
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  write_picture(folder / "glass.exr", 40, 30, [&](int column, int row) {
    if (column == 3 && row == 4) return std::array{nan, 0.0F, 0.0F, 1.0F};
    return column == 7 && row == 9 ? std::array{0.0F, infinity, 0.0F, 1.0F}
                                   : std::array{0.1F, 0.1F, 0.1F, 0.5F};
  });
  EXPECT_EQ(replaced(", glass: 2 pixels black for NaN or infinity"), (nlohmann::json{{"glass", 2}}));
  write_picture(folder / "night.exr", 16, 8, [&](int column, int row) {
    return std::array{column == 3 && row == 4 ? nan : 0.0F, 0.0F, 0.3F, 1.0F};
  });
  EXPECT_EQ(replaced(", planet: 1 pixel black for NaN or infinity"),
            (nlohmann::json{{"planet", 1}, {"glass", 2}}));
}

TEST(WholeShot, FramesThatAreMissingAreReported) {
  const TemporaryFolder folder;
  write_picture(folder / "bg.0001.exr", 8, 8, [](int, int) { return std::array{0.5F, 0.25F, 0.0F, 1.0F}; });
  const auto shot_with = [&](const std::string& missing) {
    return folder
        .write("gap.yaml",
               "lensplane: 1\nshot: gap\nframes: 1-2\ncamera: {resolution: [16, 16], fov: 3 deg}\nlayers:\n"
               "  - {name: bg, type: plate, image: {file: bg.####.exr, space: ACEScg, missing: " +
                   missing + "}}\noutput: {directory: out, review: none}\n")
        .string();
  };
  const std::string stats = (folder / "stats.json").string();
  const auto render = [&](const std::string& missing) {
    return lensplane({"render", shot_with(missing), "--stats", stats});
  };
  const auto missing_frames = [&](int frame) {
    return nlohmann::json::parse(contents_of(stats))["frames"][frame - 1]["missing_frames"];
  };
  const ProgramResult held = render("hold");
  EXPECT_EQ(held.exit_code, 0) << held.err;
  EXPECT_THAT(held.out, HasSubstr(", bg: its image is missing, 0001 is shown\n"));
  EXPECT_EQ(missing_frames(1), nlohmann::json::object());
  EXPECT_EQ(missing_frames(2), (nlohmann::json{{"bg", 1}}));
  EXPECT_NEAR(read_picture(folder / "out/gap.0002.exr").getchannel(8, 8, 0, 0), 0.5, 1e-3);
  EXPECT_THAT(render("black").out, HasSubstr("0002: "));
  EXPECT_EQ(missing_frames(2), (nlohmann::json{{"bg", nullptr}}));
  EXPECT_EQ(read_picture(folder / "out/gap.0002.exr").getchannel(8, 8, 0, 3), 0);
  const ProgramResult strict = render("error");
  EXPECT_EQ(strict.exit_code, 2);
  EXPECT_THAT(strict.err, HasSubstr("bg.0002.exr: no such image"));
}

}  // namespace
}  // namespace lensplane
