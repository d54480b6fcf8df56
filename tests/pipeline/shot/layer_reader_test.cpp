// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/layer_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/shot/example_shot.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

std::string line_for(const std::vector<std::string>& settings) {
  const Refusal refusal = refusal_of([&] { example_shot(settings); });
  EXPECT_EQ(refusal.line.find('\n'), std::string::npos);
  return refusal.line;
}

/// The setting that puts a ring with these further keys in the place of the example's plate.
std::string ring(const std::string& keys) {
  return "layers.background={name: r, type: ring, normal: [0, 1, 0], image: r.png, " + keys + "}";
}

std::string stars(const std::string& keys) {
  return "layers.background={name: s, type: stars, " + keys + "}";
}

TEST(LayerReader, ReadsRings) {
  const Shot shot = example_shot(
      {"layers.earth.light=[0, 0, 2]",
       ring("centre: earth, inner: {keys: {1001: 0 m, 1003: 2 km}}, outer: 14000 km, shadow_of: earth")});
  const auto& layer = std::get<RingLayer>(shot.layers[1].kind);
  EXPECT_EQ(std::get<LayerIndex>(layer.centre).index, 0U);
  EXPECT_EQ(value_at(layer.normal, 0), Vec3(0, 1, 0));
  EXPECT_EQ(value_at(layer.inner, 1002), 1e3);
  EXPECT_EQ(value_at(layer.outer, 0), 1.4e7);
  EXPECT_EQ(layer.shadow_of->index, 0U);
  EXPECT_FALSE(layer.light);
  EXPECT_EQ(shot.layers[1].image.pattern.text, "r.png");
  const Shot lit = example_shot(
      {ring("centre: [1 m, 2 m, 3 m], inner: 1 m, outer: 2 m, shadow_of: earth, light: [3, 0, 0]")});
  const auto& other = std::get<RingLayer>(lit.layers[1].kind);
  EXPECT_EQ(value_at(std::get<Keyed<Vec3>>(other.centre), 0), Vec3(1, 2, 3));
  EXPECT_EQ(value_at(*other.light, 0), Vec3(1, 0, 0));
  EXPECT_EQ(value_at(other.light_diameter, 0), 0);
}

TEST(LayerReader, ReadsPlatesAtADistance) {
  const auto distance = [](const std::string& text) {
    return std::get<PlateLayer>(example_shot({"layers.background.distance=" + text}).layers[1].kind).distance;
  };
  EXPECT_FALSE(distance("infinity"));
  EXPECT_EQ(value_at(*distance("2e9 m"), 0), 2e9);
  EXPECT_EQ(value_at(*distance("{keys: {1001: 1 km, 1003: 3 km}}"), 1002), 2e3);
}

TEST(LayerReader, ReadsNightSidesAndStars) {
  const Shot shot =
      example_shot({"layers.earth.light=[0, 0, 2]", "layers.earth.night={file: n.jpg, space: Raw}",
                    stars("catalogue: c.csv, exposure: {keys: {1001: 0, 1003: 1}}, rotation: [0 deg, 1 rad, "
                          "0 deg]")});
  const auto& sphere = std::get<SphereLayer>(shot.layers[0].kind);
  EXPECT_EQ(sphere.night->pattern.text, "n.jpg");
  EXPECT_EQ(sphere.night->space->text, "Raw");
  const auto& layer = std::get<StarsLayer>(shot.layers[1].kind);
  EXPECT_EQ(layer.catalogue.text, "c.csv");
  EXPECT_EQ(layer.catalogue.key, "layers.s.catalogue");
  EXPECT_EQ(value_at(layer.exposure, 1002), 0.5);
  EXPECT_EQ(value_at(layer.rotation, 0), Vec3(0, 1, 0));
  EXPECT_EQ(value_at(std::get<StarsLayer>(example_shot({stars("catalogue: c")}).layers[1].kind).exposure, 0),
            0);
}

TEST(LayerReader, StarsHaveNoMaps) {
  const auto maps = [](const std::string& chosen) {
    return example_shot({stars("catalogue: c.csv"), "output.maps=" + chosen}).output.maps;
  };
  EXPECT_EQ(maps("all"), (std::vector<bool>{true, false}));
  EXPECT_EQ(maps("[earth]"), (std::vector<bool>{true, false}));
  EXPECT_EQ(maps("null"), (std::vector<bool>{true, false}));
  EXPECT_EQ(line_for({stars("catalogue: c.csv"), "output.maps=[earth, s]"}),
            "--set output.maps:1:9: output.maps.1: \"s\" is a layer of stars, which have no map");
}

TEST(LayerReader, RefusesEveryMistake) {
  const std::pair<std::vector<std::string>, const char*> mistakes[] = {
      {{ring("centre: earth, inner: 9 km, outer: 8 km")}, "layers.r.outer: has to be larger than inner"},
      {{ring("centre: earth, inner: -1 m, outer: 8 km")}, "layers.r.inner: \"-1 m\" is negative"},
      {{ring("centre: earth, inner: 9 km, outer: {keys: {1: 10 km, 2: 8 km}}")}, "larger than inner"},
      {{ring("centre: earth, inner: 9 km")}, "layers.r.outer: missing"},
      {{ring("inner: 1 m, outer: 2 m")}, "layers.r.centre: missing; needed: [x, y, z], or the name of a"},
      {{ring("centre: mars, inner: 1 m, outer: 2 m")},
       "layers.r.centre: \"mars\" is no layer of this shot; allowed: the name of a sphere, or [x, y, z]"},
      {{ring("centre: r, inner: 1 m, outer: 2 m")}, "layers.r.centre: \"r\" is no sphere; allowed"},
      {{ring("centre: earth, inner: 1 m, outer: 2 m, radius: 2 m")}, "layers.r.radius: unknown key"},
      {{ring("centre: earth, inner: 1 m, outer: 2 m, light: [1, 0, 0]")}, "only together with shadow_of"},
      {{ring("centre: earth, inner: 1 m, outer: 2 m, shadow_of: r, light: [1, 0, 0]")},
       "layers.r.shadow_of: \"r\" is no sphere"},
      {{ring("centre: earth, inner: 1 m, outer: 2 m, shadow_of: earth")},
       "layers.r.shadow_of: \"earth\" has no light to throw a shadow in"},

      {{stars("exposure: 1")}, "layers.s.catalogue: missing"},
      {{stars("catalogue: c.csv, exposure: bright")}, "not a number"},
      {{stars("catalogue: c.csv, image: c.png")}, "layers.s.image: unknown key"},
      {{stars("catalogue: c.csv"), "camera.look_at=s"}, "has no centre to look at"},
      {{"layers.earth.light={direction: [1, 0, 0], diameter: 0 deg}"}, "layers.earth.light.diameter"},
      {{"layers.earth.light={direction: [1, 0, 0], diameter: 61 deg}"}, "allowed: up to 60 deg"},
      {{"layers.earth.light={diameter: 1 deg}"}, "layers.earth.light.direction: missing"},
      {{"layers.earth.light={direction: [1, 0, 0], size: 1 deg}"}, "size"},
      {{"layers.earth.light=[1, 0, 0]", "layers.earth.night={space: Raw}"},
       "layers.earth.night.file: missing"},
      {{"layers.background.distance=0 m"}, "not greater than 0"},
      {{"layers.background.distance=2e9 m", "camera.projection=latlong", "camera.fov=null"},
       "layers.background.distance: a plate at a distance faces a perspective camera"},
      {{"layers.background.distance=2e9 m", "camera.projection=fisheye"}, "faces a perspective camera"},
  };
  for (const auto& [settings, reason] : mistakes) {
    EXPECT_THAT(line_for(settings), HasSubstr(reason)) << settings.front();
  }
}

}  // namespace
}  // namespace lensplane
