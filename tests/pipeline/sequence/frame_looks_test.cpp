// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/frame_looks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/image/display_writer.h"
#include "pipeline/shot/shot_scene.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/shot/example_shot.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

constexpr double kRounding = 1e-14;

void write_grey(const std::filesystem::path& path, float value) {
  write_display(path, Picture{1, 1, 0, 0, 1, 1, {{value, value, value, 1}}}, 8, {});
}

/// The looks of the example, its earth a sphere and its background a ring or a plate with these keys.
class FrameLooks : public testing::Test {
 protected:
  FrameLooks() {
    write_grey(folder_ / "white.png", 1);
    write_grey(folder_ / "black.png", 0);
  }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  std::vector<SurfaceLook> looks(const std::string& sphere, const std::string& other,
                                 double time = 1001) const {
    const Shot shot = example_shot(
        {"lenses.near.mass=1 kg",
         "layers.earth={name: e, type: sphere, centre: [0 m, 0 m, -100 m], radius: 4 m, image: " +
             at("white.png") + ", " + sphere + "}",
         "layers.background={name: b, image: " + at("white.png") + ", " + other + "}"});
    const ColourConfig colours = ColourConfig::load(std::nullopt, nullptr);
    TextureStore textures(shot, colours);
    return looks_at(shot, scene_at(shot, time), textures, 1001, time);
  }

  TemporaryFolder folder_;
};

TEST_F(FrameLooks, GainIsTwoToTheExposureAtItsTime) {
  const auto exposed = looks("exposure: {keys: {1001: 0, 1003: 4}}", "type: plate, exposure: -1", 1001.5);
  EXPECT_EQ(exposed[0].gain, 2);
  EXPECT_EQ(exposed[1].gain, 0.5F);
  EXPECT_EQ(looks("light: [1, 0, 0]", "type: plate")[0].gain, 1);
}

TEST_F(FrameLooks, LightIsInTheSpheresOwnAxes) {
  // Turned by 90 degrees about y its +z lies along the world's +x.
  const std::string light = "light: [2, 0, 0], rotation: [0 deg, 90 deg, 0 deg]";
  const auto day = looks(light, "type: plate");
  ASSERT_EQ(day.size(), 2U);
  EXPECT_LT((day[0].light.value() - Vec3(0, 0, 1)).length(), kRounding);
  EXPECT_EQ(day[0].night, nullptr);
  EXPECT_FALSE(day[0].caster.has_value());
  EXPECT_FALSE(day[1].light.has_value());
  EXPECT_NEAR(day[0].texture->lookup({0.5, 0.5})[0], 1, 1e-4);
  const auto night = looks(light + ", night: " + at("black.png"), "type: plate");
  EXPECT_EQ(night[0].night->lookup({0.5, 0.5})[0], 0);
  EXPECT_FALSE(looks("rotation: [0 deg, 90 deg, 0 deg]", "type: plate")[0].light.has_value());
}

TEST_F(FrameLooks, LightFollowsItsKeysAtTheMoment) {
  const std::string keyed = "light: {keys: {1001: [1, 0, 0], 1002: [0, 1, 0]}, interpolate: step}";
  EXPECT_LT((looks(keyed, "type: plate", 1001.9)[0].light.value() - Vec3(1, 0, 0)).length(), kRounding);
  EXPECT_LT((looks(keyed, "type: plate", 1002)[0].light.value() - Vec3(0, 1, 0)).length(), kRounding);
}

TEST_F(FrameLooks, ShadowsAreInTheRingsOwnAxes) {
  // The ring stands 10 metres right of the sphere, its normal, its own +y, along +x.
  const std::string ring =
      "type: ring, centre: [10 m, 0 m, -100 m], normal: [1, 0, 0], inner: 1 m, outer: 2 m, shadow_of: e";
  const auto shadowed = looks("light: [0.6, 0.8, 0]", ring);
  ASSERT_EQ(shadowed.size(), 4U);  // bent light crosses a ring three times
  for (std::size_t k = 1; k < 4; ++k) {
    const ShadowCaster& caster = shadowed[k].caster.value();
    EXPECT_LT((caster.centre - Vec3(0, -10, 0)).length(), 1e-12);
    EXPECT_EQ(caster.radius, 4);
    EXPECT_NEAR(shadowed[k].light->y, 0.6, kRounding);
    EXPECT_NEAR(shadowed[k].light->length(), 1, kRounding);
    EXPECT_EQ(shadowed[k].texture, shadowed[1].texture);
  }
  // In a light of its own, and without shadow.
  const auto own = looks("light: [0.6, 0.8, 0]", ring + ", light: [0, 0, 3]");
  EXPECT_NEAR(own[1].light->y, 0, kRounding);
  EXPECT_NEAR(own[0].light->x, 0.6, kRounding);
  const auto bare = looks("light: [0.6, 0.8, 0]", ring.substr(0, ring.find(", shadow_of")));
  EXPECT_FALSE(bare[1].caster.has_value());
  EXPECT_FALSE(bare[1].light.has_value());
}

TEST_F(FrameLooks, ImagesThatAreMissingAreRefusedWithTheirKey) {
  const Refusal refusal =
      refusal_of([&] { looks("light: [1, 0, 0], night: " + at("none.png"), "type: plate"); });
  EXPECT_EQ(refusal.code, ExitCode::BadInput);
  EXPECT_THAT(refusal.line, testing::HasSubstr("layers.e.night: " + at("none.png")));
}

}  // namespace
}  // namespace lensplane
