// SPDX-License-Identifier: Apache-2.0
//
// Maps with filtered coverage: pictures made from them are those that are rendered, edges included.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/end_to_end/read_picture.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

constexpr int kWidth = 120, kHeight = 80;

/// Decibels, for comp against render of the scenes below: what is asked of comp.
constexpr double kSameAtEdges = 45;

/// Stripes across, fine enough that places count, opaque.
void write_stripes(const std::filesystem::path& file, double red, double blue) {
  OIIO::ImageBuf image(OIIO::ImageSpec(480, 240, 3, OIIO::TypeDesc::FLOAT));
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 480; ++x) {
      const double wave = 0.5 + 0.3 * std::sin(2 * 3.14159265 * x / 60) * std::cos(2 * 3.14159265 * y / 60);
      const float pixel[] = {static_cast<float>(red * wave), static_cast<float>(wave),
                             static_cast<float>(blue * wave)};
      image.setpixel(x, y, pixel);
    }
  }
  ASSERT_TRUE(image.write(file.string())) << image.geterror();
}

struct MapShot {
  TemporaryFolder folder;
  std::filesystem::path file;

  explicit MapShot(const std::string& scene) {
    write_stripes(folder / "warm.exr", 1, 0.2);
    write_stripes(folder / "cold.exr", 0.1, 1);
    file = folder.write("m.yaml", "lensplane: 1\nshot: m\nframes: 1\n" + scene +
                                      "output: {directory: out, image: {type: float}, review: none, data: "
                                      "[jacobian, depth]}\n");
  }
  std::filesystem::path out(const std::string& name) const { return folder / ("out/" + name); }
  std::string run(const std::string& command, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {command, file.string()};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = lensplane(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }
  OIIO::ImageBuf map(const std::string& layer) const {
    return read_picture(out("m." + layer + ".map.0001.exr"));
  }
};

double decibels(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b) {
  double sum = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int c = 0; c < 4; ++c) sum += std::pow(a.getchannel(x, y, 0, c) - b.getchannel(x, y, 0, c), 2);
    }
  }
  return -10 * std::log10(sum / (4 * kWidth * kHeight));
}

const std::string kCards = R"(camera: {resolution: [120, 80], fov: 20 deg}
lenses:
  - {name: a, radius: 0.03 m, position: [0.3 m, 0.2 m, -10 m]}
  - {name: b, radius: 0.02 m, position: [-0.6 m, -0.1 m, -10.5 m]}
layers:
  - {name: near, type: plate, image: {file: warm.exr, space: ACEScg}, edge: mirror, distance: 30 m}
  - {name: far, type: plate, image: {file: cold.exr, space: ACEScg}, edge: mirror, distance: 31 m}
)";

const std::string kGlobe = R"(camera: {resolution: [120, 80], fov: 12 deg}
lenses: [{name: a, radius: 0.05 m, position: [0.3 m, 0.2 m, -50 m]}]
layers:
  - {name: globe, type: sphere, centre: [0 m, 0 m, -100 m], radius: 4 m, rotation: [75 deg, 0 deg, 20 deg], image: {file: warm.exr, space: ACEScg}}
  - {name: sky, type: latlong, image: {file: cold.exr, space: ACEScg}}
)";

const std::string kFisheye = R"(camera: {resolution: [120, 80], fov: 200 deg, projection: fisheye}
lenses: [{name: a, radius: 0.5 m, position: [3 m, 2 m, -20 m]}]
layers: [{name: sky, type: latlong, image: {file: cold.exr, space: ACEScg}}]
)";

TEST(Maps, CompMakesTheRenderedPictureEdgesIncluded) {
  for (const std::string& scene : {kCards, kGlobe, kFisheye}) {
    const MapShot shot(scene);
    shot.run("render", {"--set", "sampling.threshold=1e-6"});
    const OIIO::ImageBuf rendered = read_picture(shot.out("m.0001.exr"));
    shot.run("comp");
    EXPECT_GT(decibels(rendered, read_picture(shot.out("m.0001.exr"))), kSameAtEdges) << scene;
  }
}

TEST(Maps, BinaryCoverageIsThatOfCentres) {
  const MapShot shot(kGlobe);
  shot.run("map");
  const OIIO::ImageBuf filtered = shot.map("globe");
  shot.run("map", {"--set", "output.maps={coverage: binary}"});
  const OIIO::ImageBuf binary = shot.map("globe");
  int soft = 0, beyond = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float s = binary.getchannel(x, y, 0, 0), t = binary.getchannel(x, y, 0, 1);
      const float coverage = binary.getchannel(x, y, 0, 2), share = filtered.getchannel(x, y, 0, 2);
      ASSERT_TRUE(coverage == 0 || coverage == 1);
      soft += share > 0 && share < 1 ? 1 : 0;
      if (coverage == 1) {
        ASSERT_EQ(s, filtered.getchannel(x, y, 0, 0));
        ASSERT_EQ(t, filtered.getchannel(x, y, 0, 1));
      } else {
        ASSERT_EQ(s + t, 0);
        beyond += filtered.getchannel(x, y, 0, 1) > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(soft, 200);
  EXPECT_GT(beyond, 400);
}

TEST(Maps, AnotherCoverageMakesMapsAnewAndNoPicture) {
  const MapShot shot(kFisheye);
  shot.run("render");
  const auto time_of = [&](const std::string& name) {
    return std::filesystem::last_write_time(shot.out(name));
  };
  const auto map = time_of("m.sky.map.0001.exr"), data = time_of("m.sky.data.0001.exr"),
             picture = time_of("m.0001.exr");
  shot.run("render");
  EXPECT_EQ(time_of("m.sky.map.0001.exr"), map);
  shot.run("render", {"--set", "output.maps={coverage: binary}"});
  EXPECT_NE(time_of("m.sky.map.0001.exr"), map);
  EXPECT_NE(time_of("m.sky.data.0001.exr"), data);
  EXPECT_EQ(time_of("m.0001.exr"), picture);
}

}  // namespace
}  // namespace lensplane
