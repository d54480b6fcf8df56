// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/star_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/shot/example_shot.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

// Light passes through colour management as floats.
constexpr double kFloatError = 2e-6;

// Of the published matrix, to its digits.
constexpr double kMatrixError = 1e-5;

// Two stars on the equator: straight ahead along -z, and to the left along -x.
const char* const kTwoStars = "ra_deg,dec_deg,v_mag,b_minus_v\n0,0,0,0.6\n90,0,5,0.6\n";

ColourConfig builtin() {
  return ColourConfig::load(std::nullopt, nullptr);
}

/// The example with stars as its layer 1.
Shot shot_with(const std::filesystem::path& catalogue, const std::string& keys,
               const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings = {
      "layers.background={name: s, type: stars, catalogue: " + catalogue.string() + keys + "}"};
  settings.insert(settings.end(), more.begin(), more.end());
  return example_shot(settings);
}

void expect_direction(const StarField& field, std::size_t star, const Vec3& expected) {
  EXPECT_LT((field.index.directions()[star] - expected).length(), 1e-14) << field.index.directions()[star];
}

TEST(StarStore, GivesStarsAsTheCatalogueHasThem) {
  const TemporaryFolder folder;
  const Shot shot = shot_with(folder.write("two.csv", kTwoStars), "");
  const ColourConfig colours = builtin();
  const auto field = StarStore(shot, colours).field(1, 1001);
  ASSERT_EQ(field->light.size(), 2U);
  expect_direction(*field, 0, {0, 0, -1});
  expect_direction(*field, 1, {-1, 0, 0});
  const Rgb colour = star_colour(0.6);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(field->light[0][c] / (16 * colour[c]), 1, kFloatError);
    EXPECT_NEAR(field->light[1][c] / (0.16 * colour[c]), 1, kFloatError);  // five magnitudes: a hundredth
  }
}

TEST(StarStore, TurnsThemAboutZThenXThenY) {
  const TemporaryFolder folder;
  const auto file = folder.write("two.csv", kTwoStars);
  const ColourConfig colours = builtin();
  const auto turned = [&](const std::string& rotation) {
    const Shot shot = shot_with(file, ", rotation: " + rotation);
    return StarStore(shot, colours).field(1, 1001);
  };
  expect_direction(*turned("[0 deg, 90 deg, 0 deg]"), 0, {-1, 0, 0});
  expect_direction(*turned("[0 deg, 90 deg, 0 deg]"), 1, {0, 0, 1});
  expect_direction(*turned("[90 deg, 0 deg, 0 deg]"), 0, {0, 1, 0});
  expect_direction(*turned("[0 deg, 0 deg, 90 deg]"), 1, {0, -1, 0});
  expect_direction(*turned("[90 deg, 90 deg, 0 deg]"), 0, {0, 1, 0});  // the other way about (-1, 0, 0)
  expect_direction(*turned("[90 deg, 0 deg, 90 deg]"), 1, {0, 0, -1});
}

TEST(StarStore, ExposureDoublesLightAndFollowsItsKeys) {
  const TemporaryFolder folder;
  const Shot shot = shot_with(folder.write("two.csv", kTwoStars), ", exposure: {keys: {1001: 0, 1003: -4}}");
  const ColourConfig colours = builtin();
  StarStore store(shot, colours);
  const auto whole = store.field(1, 1001), quarter = store.field(1, 1002), half = store.field(1, 1001.5);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(quarter->light[0][c], whole->light[0][c] / 4, 1e-12);
    EXPECT_NEAR(half->light[1][c], whole->light[1][c] / 2, 1e-12);
  }
}

TEST(StarStore, ReadsOnceAndKeepsWhatDoesNotChange) {
  const TemporaryFolder folder;
  const auto file = folder.write("two.csv", kTwoStars);
  const Shot shot =
      shot_with(file,
                ", exposure: {keys: {1001: 0, 1002: 1}}, rotation: {keys: {1004: [0 deg, 0 deg, 0 deg], "
                "1005: [0 deg, 90 deg, 0 deg]}}");
  const ColourConfig colours = builtin();
  StarStore store(shot, colours);
  const auto first = store.field(1, 1001);
  EXPECT_EQ(store.field(1, 1001), first);
  EXPECT_EQ(store.field(1, 1000), first);  // before the first key nothing changes
  const auto brighter = store.field(1, 1002);
  EXPECT_NE(brighter, first);
  EXPECT_EQ(store.field(1, 1003), brighter);
  const auto turned = store.field(1, 1005);
  EXPECT_NE(turned, brighter);
  expect_direction(*turned, 0, {-1, 0, 0});
  // What is in use stays as it is, and the file is not read again.
  expect_direction(*first, 0, {0, 0, -1});
  std::filesystem::remove(file);
  expect_direction(*store.field(1, 1001), 0, {0, 0, -1});
}

TEST(StarStore, LightIsInTheWorkingSpace) {
  const TemporaryFolder folder;
  const auto file = folder.write("two.csv", kTwoStars);
  const ColourConfig colours = builtin();
  const Shot shot = shot_with(file, "", {"colour.working=ACES2065-1"});
  const Rgb light = StarStore(shot, colours).field(1, 1001)->light[0];
  // AP1 to AP0, S-2014-004.
  const double matrix[3][3] = {{0.6954522414, 0.1406786965, 0.1638690622},
                               {0.0447945634, 0.8596711185, 0.0955343182},
                               {-0.0055258826, 0.0040252103, 1.0015006723}};
  const Rgb acescg = star_colour(0.6);
  for (std::size_t row = 0; row < 3; ++row) {
    double expected = 0;
    for (std::size_t c = 0; c < 3; ++c) expected += 16 * matrix[row][c] * acescg[c];
    EXPECT_NEAR(light[row] / expected, 1, kMatrixError) << row;
  }
}

TEST(StarStore, FailuresNameTheKeyOfTheShot) {
  const TemporaryFolder folder;
  const ColourConfig colours = builtin();
  const auto refusal = [&](const Shot& shot, const ColourConfig& config) {
    return refusal_of([&] { StarStore(shot, config).field(1, 1001); });
  };
  const Refusal missing = refusal(shot_with(folder / "none.csv", ""), colours);
  EXPECT_EQ(missing.code, ExitCode::BadInput);
  EXPECT_THAT(missing.line, HasSubstr("layers.s.catalogue: " + (folder / "none.csv").string() +
                                      ": no such star catalogue"));
  const auto broken = folder.write("broken.csv", "ra_deg,dec_deg,v_mag,b_minus_v\n400,0,0,0\n");
  EXPECT_THAT(refusal(shot_with(broken, ""), colours).line,
              HasSubstr("layers.s.catalogue: " + broken.string() + ":2: ra_deg"));
  // A config that does not know the space of the stars' light.
  const auto own = folder.write("own.ocio",
                                "ocio_profile_version: 1\nroles: {default: mine}\ndisplays:\n  screen:\n"
                                "    - !<View> {name: it, colorspace: mine}\n"
                                "colorspaces:\n  - !<ColorSpace> {name: mine}\n");
  const ColourConfig without = ColourConfig::load(own.string(), nullptr);
  const Shot shot = shot_with(folder.write("two.csv", kTwoStars), "", {"colour.working=mine"});
  const Refusal unknown = refusal(shot, without);
  EXPECT_EQ(unknown.code, ExitCode::BadInput);
  EXPECT_THAT(unknown.line, HasSubstr("layers.s.catalogue: "));
  EXPECT_THAT(unknown.line, HasSubstr("lin_ap1_scene"));
}

}  // namespace
}  // namespace lensplane
