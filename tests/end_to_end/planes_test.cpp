// SPDX-License-Identifier: Apache-2.0
//
// Shots by the method `planes`: their data files, their plan, and single rays of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/read_picture.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

const std::string kShot = R"(lensplane: 1
shot: p
frames: 1001-1002
camera: {resolution: [200, 90], fov: 3 deg}
lenses:
  - {name: near, mass: 1.989e31 kg, position: [1e6 m, 0 m, -4.36e8 m]}
  - {name: dust, mass: 1 kg, position: [0 m, 1e6 m, -2e8 m]}
layers:
  - name: earth
    type: sphere
    centre: [0 m, 0 m, -1.09e9 m]
    radius: 6371 km
    image: lensplane:textures/earth_night.jpg
  - {name: sky, type: latlong, image: lensplane:textures/earth_night.jpg}
output: {directory: out, review: none}
)";

const std::string kPasses = "output.data=[shadow, depth, direction]";

/// The shot in a folder of its own.
struct ShotFolder {
  TemporaryFolder folder;
  std::string shot = folder.write("p.yaml", kShot).string();

  std::filesystem::path out(const std::string& name) const { return folder.path() / "out" / name; }
  ProgramResult run(const std::string& command, std::vector<std::string> words) const {
    words.insert(words.begin(), {command, shot});
    ProgramResult result = lensplane(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result;
  }
  ProgramResult map(const std::vector<std::string>& settings) const {
    std::vector<std::string> words = {"-f", "1001", "--quiet"};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    return run("map", words);
  }
};

std::vector<std::string> channels_of(const std::filesystem::path& path) {
  std::vector<std::string> names = read_picture(path).spec().channelnames;
  std::sort(names.begin(), names.end());
  return names;
}

float value_at(const OIIO::ImageBuf& image, const std::string& channel, int x, int y) {
  const int index = image.spec().channelindex(channel);
  EXPECT_GE(index, 0) << channel;
  return image.getchannel(x, y, 0, index);
}

TEST(DataFiles, HoldThePassesAskedForAndOnlyThose) {
  const ShotFolder shot;
  shot.map({kPasses});
  for (const char* layer : {"earth", "sky"}) {
    EXPECT_THAT(channels_of(shot.out(std::string("p.") + layer + ".data.1001.exr")),
                ElementsAre("depth.z", "dir.x", "dir.y", "dir.z", "lensing.shadow"));
    EXPECT_THAT(channels_of(shot.out(std::string("p.") + layer + ".map.1001.exr")),
                ElementsAre("B", "G", "R"));
  }
  shot.map({"output.data=all", "output.maps=[sky]"});
  EXPECT_THAT(channels_of(shot.out("p.sky.data.1001.exr")),
              ElementsAre("depth.z", "dir.x", "dir.y", "dir.z", "jacobian.ds_dx", "jacobian.ds_dy",
                          "jacobian.dt_dx", "jacobian.dt_dy", "lensing.bends", "lensing.delay",
                          "lensing.magnification", "lensing.shadow"));
  EXPECT_THAT(channels_of(shot.out("p.earth.data.1001.exr")), testing::SizeIs(5));
}

TEST(DataFiles, HaveTheWindowsAndTheHeaderOfTheMap) {
  const ShotFolder shot;
  shot.map({kPasses, "camera.overscan=6"});
  const OIIO::ImageBuf data = read_picture(shot.out("p.sky.data.1001.exr")),
                       map = read_picture(shot.out("p.sky.map.1001.exr"));
  const OIIO::ImageSpec &a = data.spec(), &b = map.spec();
  EXPECT_EQ(a.width, 212);
  EXPECT_EQ(a.x, -6);
  EXPECT_EQ(a.full_width, 200);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(data.file_format_name(), std::string("openexr"));
  EXPECT_EQ(data.nativespec().format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(a.get_string_attribute("compression"), "zip");
  for (const char* name : {"lensplane:version", "lensplane:shot", "lensplane:st_origin", "colorInteropID"})
    EXPECT_EQ(a.get_string_attribute(name), b.get_string_attribute(name)) << name;
  EXPECT_NE(a.get_string_attribute("lensplane:parameters"), b.get_string_attribute("lensplane:parameters"));
  EXPECT_THAT(std::string(a.get_string_attribute("lensplane:plan")), HasSubstr("planes: "));
}

TEST(DataFiles, ChangeNoMapAndAreIndependentOfThreads) {
  const ShotFolder shot;
  shot.map({});
  const std::string alone = contents_of(shot.out("p.sky.map.1001.exr"));
  std::vector<std::string> data;
  for (const char* threads : {"1", "3"}) {
    shot.run("map", {"-f", "1001", "--quiet", "--redo", "--threads", threads, "--set", "output.data=all"});
    EXPECT_TRUE(contents_of(shot.out("p.sky.map.1001.exr")) == alone) << threads;
    data.push_back(contents_of(shot.out("p.sky.data.1001.exr")));
  }
  EXPECT_TRUE(data[0] == data[1]);
}

TEST(DataFiles, AreMadeWhenTheyAreNotThereOrNotRight) {
  const ShotFolder shot;
  const auto path = shot.out("p.sky.data.1001.exr");
  const auto render = [&](const std::string& passes) {
    return shot.run("render", {"-f", "1001", "--set", passes}).out;
  };
  render(kPasses);
  const std::string first = contents_of(path);
  const auto map_time = std::filesystem::last_write_time(shot.out("p.sky.map.1001.exr"));
  const auto picture_time = std::filesystem::last_write_time(shot.out("p.1001.exr"));
  EXPECT_THAT(render(kPasses), HasSubstr("already done"));
  std::filesystem::resize_file(path, 1000);
  EXPECT_EQ(render(kPasses).find("already done"), std::string::npos);
  EXPECT_TRUE(contents_of(path) == first);
  std::filesystem::remove(path);
  render(kPasses);
  EXPECT_TRUE(contents_of(path) == first);
  EXPECT_EQ(render("output.data=[shadow]").find("already done"), std::string::npos);
  EXPECT_THAT(channels_of(path), ElementsAre("lensing.shadow"));
  // Nothing else is touched by any of this.
  EXPECT_EQ(std::filesystem::last_write_time(shot.out("p.sky.map.1001.exr")), map_time);
  EXPECT_EQ(std::filesystem::last_write_time(shot.out("p.1001.exr")), picture_time);
  EXPECT_THAT(render("output.data=none"), HasSubstr("already done"));
}

TEST(DataFiles, AreOutputsLikeTheOthers) {
  const ShotFolder shot;
  shot.run("map", {"-f", "1001", "--quiet", "--proxy", "2", "--set", kPasses});
  EXPECT_EQ(read_picture(shot.out("proxy2/p.sky.data.1001.exr")).spec().width, 100);
  EXPECT_FALSE(std::filesystem::exists(shot.out("p.sky.data.1001.exr")));
  const ProgramResult refused =
      lensplane({"render", shot.shot, "--set", "layers.sky.image=out/p.earth.data.1001.exr"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("would overwrite it"));
}

TEST(DataFiles, WhatLiesAtInfinityHasTheLargestDepth) {
  const ShotFolder shot;
  shot.map({"output.data=[depth, direction]"});
  const OIIO::ImageBuf sky = read_picture(shot.out("p.sky.data.1001.exr")),
                       map = read_picture(shot.out("p.sky.map.1001.exr"));
  ASSERT_EQ(value_at(map, "B", 3, 3), 1);
  EXPECT_EQ(value_at(sky, "depth.z", 3, 3), std::numeric_limits<float>::max());
  const double x = value_at(sky, "dir.x", 3, 3), y = value_at(sky, "dir.y", 3, 3),
               z = value_at(sky, "dir.z", 3, 3);
  EXPECT_NEAR(std::sqrt(x * x + y * y + z * z), 1, 1e-6);
}

TEST(Probe, AgreesWithTheMapAndTheDataFiles) {
  const ShotFolder shot;
  shot.map({"output.data=all", "output.maps={coverage: binary}"});
  int hits = 0;
  for (const auto& [x, y] : {std::pair{3, 5}, {60, 40}, {100, 20}, {150, 70}, {199, 89}}) {
    const Json json = Json::parse(shot.run("probe", {"-f", "1001", "--json", "-x", std::to_string(x) + ".5",
                                                     "-y", std::to_string(y) + ".5"})
                                      .out);
    EXPECT_EQ(json["in_frame"], true);
    for (const Json& layer : json["layers"]) {
      const std::string name = layer["layer"];
      const OIIO::ImageBuf map = read_picture(shot.out("p." + name + ".map.1001.exr")),
                           data = read_picture(shot.out("p." + name + ".data.1001.exr"));
      const bool hit = layer["outcome"] == "hit";
      EXPECT_EQ(value_at(map, "B", x, y), hit ? 1 : 0) << name << x;
      EXPECT_NEAR(value_at(map, "R", x, y), layer["s"].get<double>(), 1e-7) << name << x;
      EXPECT_NEAR(value_at(map, "G", x, y), layer["t"].get<double>(), 1e-7) << name << x;
      if (!hit) continue;
      ++hits;
      const auto expect_same = [&](const std::string& channel, double expected) {
        EXPECT_NEAR(value_at(data, channel, x, y), expected, 1e-6 * std::abs(expected) + 1e-30) << channel;
      };
      expect_same("lensing.magnification", layer["magnification"]);
      expect_same("lensing.delay", layer["delay"]);
      expect_same("jacobian.ds_dx", layer["ds_dx"]);
      expect_same("jacobian.dt_dy", layer["dt_dy"]);
      if (!layer["distance"].is_null()) expect_same("depth.z", layer["distance"]);
    }
  }
  EXPECT_GE(hits, 6);
}

TEST(Probe, SaysWhatHappensToTheRay) {
  const ShotFolder shot;
  const Json json = Json::parse(shot.run("probe", {"-f", "1002", "-x", "-3.25", "-y", "45", "--json"}).out);
  EXPECT_EQ(json["frame"], 1002);
  EXPECT_EQ(json["x"], -3.25);
  EXPECT_EQ(json["in_frame"], false);
  EXPECT_EQ(json["seen"], true);
  ASSERT_GE(json["crossings"].size(), 1U);
  const Json& crossing = json["crossings"].back();
  EXPECT_EQ(crossing["lens"], "near");
  EXPECT_NEAR(crossing["alpha_rad"].get<double>() * crossing["b_over_m"].get<double>(), 4, 0.1);
  const std::string text = shot.run("probe", {"-f", "1002", "-x", "-3.25", "-y", "45"}).out;
  EXPECT_THAT(text, HasSubstr("outside the frame"));
  EXPECT_THAT(text, HasSubstr("layer sky: hit"));
}

TEST(Probe, RefusesWhatIsNoPosition) {
  const ShotFolder shot;
  const auto refused = [&](const std::vector<std::string>& words, const std::string& reason) {
    std::vector<std::string> all = {"probe", shot.shot};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramResult result = lensplane(all);
    EXPECT_EQ(result.exit_code, 1) << result.out;
    EXPECT_THAT(result.err, HasSubstr(reason));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(result.out, "");
  };
  for (const char* wrong : {"left", "nan", "inf", "1e999", "3px", ""})
    refused({"-f", "1001", "-x", wrong, "-y", "1"}, std::string("-x: \"") + wrong + "\" is not a position");
  refused({"-f", "1001", "-x", "1", "-y", "1,5"}, "-y: \"1,5\" is not a position on the film");
  refused({"-f", "1001", "-x", "1"}, "-y is required");
  refused({"-x", "1", "-y", "1"}, "-f: a probe has one frame, not 2; write -f 1001");
}

TEST(Plan, SaysWhatIsSimulatedAndWhy) {
  const ShotFolder shot;
  const std::string text = shot.run("plan", {}).out;
  EXPECT_THAT(text, HasSubstr("shot p, frame 1001: method planes, tolerance 0.05 px"));
  EXPECT_THAT(text, HasSubstr("near  10"));
  EXPECT_THAT(text, HasSubstr("culled"));
  EXPECT_EQ(text.find("1002"), std::string::npos);
  EXPECT_THAT(shot.run("plan", {"-f", "1001-1002"}).out, HasSubstr("frame 1002"));
  EXPECT_EQ(shot.run("plan", {"--quiet"}).out, "");
  EXPECT_FALSE(std::filesystem::exists(shot.folder / "out"));
}

TEST(Plan, IsThereForPrograms) {
  const ShotFolder shot;
  const Json json = Json::parse(shot.run("plan", {"--json", "--set", kPasses}).out);
  EXPECT_EQ(json["shot"], "p");
  ASSERT_EQ(json["frames"].size(), 1U);
  const Json& frame = json["frames"][0];
  for (const char* key : {"frame", "method", "law", "tolerance_px", "bound_px", "summary", "lenses",
                          "effects", "recipes", "tiles"}) {
    EXPECT_TRUE(frame.contains(key)) << key;
  }
  ASSERT_EQ(frame["lenses"].size(), 2U);
  EXPECT_EQ(frame["lenses"][0]["name"], "near");
  EXPECT_EQ(frame["lenses"][0]["culled"], false);
  EXPECT_EQ(frame["lenses"][1]["culled"], true);
  EXPECT_NEAR(frame["lenses"][0]["mass_kg"].get<double>(), 1.989e31, 1e17);
  EXPECT_LE(frame["bound_px"].get<double>(), 0.05);
  double share = 0;
  for (const Json& recipe : frame["recipes"]) share += recipe["share"].get<double>();
  EXPECT_NEAR(share, 1, 1e-12);
  const auto on = [&](const std::string& name) {
    for (const Json& effect : frame["effects"]) {
      if (effect["name"] == name) return effect["on"].get<bool>();
    }
    ADD_FAILURE() << name;
    return false;
  };
  EXPECT_TRUE(on("shadow"));
  EXPECT_FALSE(on("jacobian"));
}

TEST(Plan, KnowsEveryMethod) {
  const ShotFolder shot;
  for (const char* method : {"kishi", "shinotsuka-makino", "planes", "geodesic"}) {
    const std::string setting = std::string("trace.method=") + method;
    EXPECT_THAT(shot.run("plan", {"--set", setting}).out, HasSubstr(std::string("method ") + method));
    const Json json = Json::parse(shot.run("plan", {"--json", "--set", setting}).out);
    EXPECT_EQ(json["frames"][0]["method"], method);
    EXPECT_EQ(json["frames"][0]["lenses"].size(), 2U);
  }
}

}  // namespace
}  // namespace lensplane
