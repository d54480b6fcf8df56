// SPDX-License-Identifier: Apache-2.0

#include "pipeline/colour/colour_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

constexpr double kColourError = 1e-4;

ColourConfig builtin() {
  return ColourConfig::load(std::nullopt, nullptr);
}

template <class Sample>
EncodedImage pixel(SampleType type, const std::array<Sample, 4>& rgba, bool has_alpha, bool premultiplied) {
  EncodedImage image{1, 1, 0, 0, 1, 1, type, has_alpha, premultiplied, Samples(sizeof rgba)};
  std::memcpy(image.samples.data(), rgba.data(), sizeof rgba);
  return image;
}

Rgba working_from(const std::string& space, const std::array<float, 3>& rgb) {
  const auto image = pixel<float>(SampleType::Float, {rgb[0], rgb[1], rgb[2], 1}, false, true);
  return builtin().to_working(image, {space, std::nullopt, false}, "ACEScg").pixels[0];
}

float shown(float value, const std::string& display, const std::string& view) {
  const Picture picture{1, 1, 0, 0, 1, 1, {{value, value, value, 1}}};
  return builtin().to_display(picture, {"ACEScg", display, view}).pixels[0][0];
}

void expect_near(const Rgba& colour, double r, double g, double b) {
  EXPECT_NEAR(colour[0], r, kColourError);
  EXPECT_NEAR(colour[1], g, kColourError);
  EXPECT_NEAR(colour[2], b, kColourError);
}

TEST(ColourConfig, AnchorsIntoTheWorkingSpace) {
  expect_near(working_from("sRGB - Texture", {0.5F, 0.5F, 0.5F}), 0.21404, 0.21404, 0.21404);
  expect_near(working_from("Linear Rec.709 (sRGB)", {1, 0, 0}), .6131, .07019, .02062);
  expect_near(working_from("ACEScg", {0.3F, 0.2F, 0.1F}), 0.3, 0.2, 0.1);
}

TEST(ColourConfig, AnchorsOutOfTheWorkingSpace) {
  EXPECT_NEAR(shown(0.18F, "sRGB - Display", "ACES 1.0 - SDR Video"), 0.35595, kColourError);
  EXPECT_NEAR(shown(0.18F, "Rec.1886 Rec.709 - Display", "ACES 1.0 - SDR Video"), 0.38953, kColourError);
  EXPECT_NEAR(shown(0.18F, "P3-D65 - Display", "ACES 1.0 - SDR Cinema"), 0.41187, kColourError);
  EXPECT_NEAR(shown(16.0F, "sRGB - Display", "ACES 1.0 - SDR Video"), 0.99974, kColourError);
}

TEST(ColourConfig, EightAndSixteenBitFilesGiveWhatFloatGives) {
  for (const int code : {0, 1, 10, 64, 128, 200, 255}) {
    const auto value = static_cast<float>(code) / 255.0F;
    const Rgba expected = working_from("sRGB - Texture", {value, value, value});
    const auto byte = static_cast<std::uint8_t>(code);
    const auto word = static_cast<std::uint16_t>(code * 257);
    const auto from8 = pixel<std::uint8_t>(SampleType::UInt8, {byte, byte, byte, 255}, false, true);
    const auto from16 = pixel<std::uint16_t>(SampleType::UInt16, {word, word, word, 65535}, false, true);
    for (const EncodedImage& image : {from8, from16}) {
      const Rgba got =
          builtin().to_working(image, {"sRGB - Texture", std::nullopt, false}, "ACEScg").pixels[0];
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], expected[c], 1e-6) << code;
    }
  }
}

TEST(ColourConfig, AlphaIsPremultipliedInLinearLight) {
  const auto with = [](bool premultiplied, const ImageEncoding& encoding, float value) {
    const auto image = pixel<float>(SampleType::Float, {value, value, value, 0.5F}, true, premultiplied);
    return builtin().to_working(image, encoding, "ACEScg").pixels[0];
  };
  const Rgba straight = with(false, {"sRGB - Texture", std::nullopt, false}, 0.5F);
  EXPECT_NEAR(straight[0], 0.21404 / 2, kColourError);
  EXPECT_EQ(straight[3], 0.5F);
  // The same pixel stored premultiplied: 0.25 with alpha 0.5.
  EXPECT_NEAR(with(true, {"sRGB - Texture", std::nullopt, false}, 0.25F)[0], 0.21404 / 2, kColourError);
  // What the shot says goes before what the file says.
  EXPECT_NEAR(with(true, {"sRGB - Texture", false, false}, 0.5F)[0], 0.21404 / 2, kColourError);
  const Rgba ignored = with(false, {"sRGB - Texture", std::nullopt, true}, 0.5F);
  EXPECT_NEAR(ignored[0], 0.21404, kColourError);
  EXPECT_EQ(ignored[3], 1.0F);
}

TEST(ColourConfig, LightWithoutCoverKeepsItsColour) {
  const auto image = pixel<float>(SampleType::Float, {2, 2, 2, 0}, true, true);
  const Rgba got = builtin().to_working(image, {"ACEScg", std::nullopt, false}, "ACEScg").pixels[0];
  EXPECT_EQ(got[3], 0.0F);
  EXPECT_NEAR(got[0], 2, kColourError);
}

TEST(ColourConfig, WhatIsNoNumberOrTooBrightStaysFinite) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::array<float, 4>& bad : {std::array<float, 4>{nan, 0, 0, 1},
                                          {inf, 1, 1, 1},
                                          {1, 1, -inf, 1},
                                          {1, 1, 1, nan},
                                          {-3e38F, -3e38F, -3e38F, 0.5F},
                                          {1e38F, 1e38F, 1e38F, 1e-38F}}) {
    for (const bool has_alpha : {false, true}) {
      for (const char* space : {"ACEScg", "sRGB - Texture"}) {
        const auto image = pixel<float>(SampleType::Float, bad, has_alpha, true);
        const Rgba got = builtin().to_working(image, {space, std::nullopt, false}, "ACEScg").pixels[0];
        for (const float channel : got) {
          EXPECT_TRUE(std::isfinite(channel) && std::abs(channel) <= kBrightest);
        }
      }
    }
  }
}

TEST(ColourConfig, PixelsThatAreNoNumbersBecomeBlackAndAreCounted) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const std::array<float, 16> samples = {1, 2, 3, 1, nan, 1, 1, 1, 1, inf, 1, 0.5F, 4, 5, 6, 1};
  EncodedImage image{4, 1, 0, 0, 4, 1, SampleType::Float, true, true, Samples(sizeof samples)};
  std::memcpy(image.samples.data(), samples.data(), sizeof samples);
  const Picture got = builtin().to_working(image, {"ACEScg", std::nullopt, false}, "ACEScg");
  EXPECT_EQ(got.not_numbers, 2);
  EXPECT_EQ(got.pixels[1], (Rgba{0, 0, 0, 1}));
  EXPECT_EQ(got.pixels[2], (Rgba{0, 0, 0, 0.5F}));
  expect_near(got.pixels[3], 4, 5, 6);
}

TEST(ColourConfig, FilesGetTheirSpacesByTheRules) {
  EXPECT_EQ(builtin().space_of_file("textures/earth_day.jpg"), "sRGB - Texture");
  EXPECT_EQ(builtin().space_of_file("plates/bg.1001.exr"), "ACEScg");
  EXPECT_EQ(builtin().space_of_file("plates/bg_lin_rec709.exr"), "Linear Rec.709 (sRGB)");
}

TEST(ColourConfig, WhatAFileSaysGoesBeforeTheRules) {
  EXPECT_EQ(builtin().space_of_file("bg.exr", "lin_rec709_scene"), "Linear Rec.709 (sRGB)");
  EXPECT_EQ(builtin().space_of_file("bg.png", "lin_ap0_scene"), "ACES2065-1");
  EXPECT_EQ(builtin().space_of_file("bg.exr", "srgb_rec709_display"), "sRGB - Display");
  EXPECT_EQ(builtin().space_of_file("bg.exr", "data"), "Raw");
  EXPECT_EQ(builtin().space_of_file("bg.png", "unknown"), "sRGB - Texture");
  const Refusal refusal = refusal_of([] { builtin().space_of_file("bg.exr", "lin_moon_scene"); });
  EXPECT_EQ(refusal.code, ExitCode::BadInput);
  EXPECT_EQ(refusal.line,
            "bg.exr: its colorInteropID \"lin_moon_scene\" is no colour space of the OCIO config; say which "
            "one it is by space");
}

TEST(ColourConfig, KnowsWhatDisplaysShow) {
  EXPECT_EQ(builtin().display_interop_id("sRGB - Display", "ACES 1.0 - SDR Video"), "srgb_rec709_display");
  EXPECT_EQ(builtin().display_interop_id("P3-D65 - Display", "Un-tone-mapped"), "g26_p3d65_display");
  EXPECT_EQ(builtin().display_interop_id("sRGB - Display", "Raw"), "");
}

constexpr const char* kCdl = R"(<ColorCorrectionCollection xmlns="urn:ASC:CDL:v1.2">
<ColorCorrection id="half"><SOPNode><Slope>0.5 0.5 0.5</Slope><Offset>0 0 0</Offset><Power>1 1 1</Power></SOPNode></ColorCorrection>
<ColorCorrection id="lift"><SOPNode><Slope>1 1 1</Slope><Offset>0.1 0 0</Offset><Power>1 1 1</Power></SOPNode></ColorCorrection>
</ColorCorrectionCollection>)";

TEST(ColourConfig, GradesBeforeTheView) {
  const TemporaryFolder folder;
  const std::string cdl = folder.write("grade.ccc", kCdl).string();
  const auto graded = [&](float value, const std::string& id, const std::string& space) {
    const Picture picture{1, 1, 0, 0, 1, 1, {{value, value, value, 1}}};
    const ViewSettings view{"ACEScg", "sRGB - Display", "ACES 1.0 - SDR Video", Grade{cdl, id, space}};
    return builtin().to_display(picture, view).pixels[0];
  };
  const float half = shown(0.2F, "sRGB - Display", "ACES 1.0 - SDR Video");
  EXPECT_NEAR(graded(0.4F, "", "ACEScg")[1], half, 1e-5);
  EXPECT_NEAR(graded(0.4F, "half", "ACEScg")[1], half, 1e-5);
  EXPECT_GT(graded(0.2F, "lift", "ACEScg")[0], graded(0.2F, "lift", "ACEScg")[1] + 0.05F);
  // An offset of a logarithm is a factor of light.
  EXPECT_GT(graded(0.2F, "lift", "ACEScct")[0], graded(0.2F, "lift", "ACEScg")[0] + 0.05F);
  const ViewSettings plain{"ACEScg", "sRGB - Display", "Un-tone-mapped"};
  ViewSettings with = plain;
  with.grade = Grade{cdl, "half", "ACEScg"};
  EXPECT_NE(builtin().view_id(plain), builtin().view_id(with));
}

TEST(ColourConfig, NothingIsShownAsAnyOtherPixel) {
  const TemporaryFolder folder;
  const std::string cdl = folder.write("grade.ccc", kCdl).string();  // makes some red of black
  const ViewSettings view{"ACEScg", "sRGB - Display", "ACES 1.0 - SDR Video", Grade{cdl, "lift", "ACEScg"}};
  const Rgba nothing{0, 0, 0, 0}, black{0, 0, 0, 1}, light{0.4F, 0.2F, 0.1F, 1}, haze{0.1F, 0.1F, 0.2F, 0};
  const Picture picture{3, 2, 0, 0, 3, 2, {nothing, light, nothing, haze, black, nothing}};
  const Picture shown = builtin().to_display(picture, view);
  EXPECT_GT(shown.at(0, 0)[0], 0.1F);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Picture alone{1, 1, 0, 0, 1, 1, {picture.pixels[i]}};
    EXPECT_EQ(shown.pixels[i], builtin().to_display(alone, view).pixels[0]) << i;
  }
}

TEST(ColourConfig, GradesThatCannotBeReadAreRefusedByName) {
  const TemporaryFolder folder;
  const auto line = [&](const std::string& name, const std::string& id) {
    const Refusal refusal = refusal_of([&] {
      builtin().check_grade({(folder / name).string(), id, "ACEScg"});
    });
    EXPECT_EQ(refusal.code == ExitCode::BadInput, !refusal.line.empty());
    return refusal.line;
  };
  folder.write("grade.ccc", kCdl);
  folder.write("broken.cc", "<ColorCorrection><SOPNode>");
  EXPECT_EQ(line("grade.ccc", "half"), "");
  EXPECT_EQ(line("none.cc", ""), (folder / "none.cc").string() + ": no such file");
  EXPECT_THAT(line("broken.cc", ""), HasSubstr("broken.cc: cannot be read as a CDL: "));
  EXPECT_THAT(line("grade.ccc", "third"), HasSubstr("grade.ccc: cannot be read as a CDL: "));
}

TEST(ColourConfig, KnowsWhatSpacesAreCalledElsewhere) {
  EXPECT_EQ(builtin().interop_id("ACEScg"), "lin_ap1_scene");
  EXPECT_EQ(builtin().interop_id("ACES2065-1"), "lin_ap0_scene");
  EXPECT_EQ(builtin().interop_id("Linear Rec.709 (sRGB)"), "lin_rec709_scene");
  EXPECT_EQ(builtin().interop_id("ACEScct"), "");
  EXPECT_NEAR((*builtin().chromaticities("ACEScg"))[0][0], .713, 1e-6);
  EXPECT_FALSE(builtin().chromaticities("ACEScct"));
}

TEST(ColourConfig, KnowsInWhichSpacesLightAddsUp) {
  for (const char* space : {"ACEScg", "ACES2065-1", "Linear Rec.709 (sRGB)"})
    EXPECT_TRUE(builtin().is_scene_linear(space));
  for (const char* space : {"sRGB - Texture", "ACEScct", "Raw", "sRGB - Display", "none"}) {
    EXPECT_FALSE(builtin().is_scene_linear(space)) << space;
  }
}

TEST(ColourConfig, ConversionsAreKnownByWhatTheyCompute) {
  EXPECT_EQ(builtin().conversion_id("ACEScg", "ACES2065-1"), builtin().conversion_id("acescg", "lin_ap0"));
  EXPECT_NE(builtin().conversion_id("ACEScg", "ACES2065-1"),
            builtin().conversion_id("ACEScct", "ACES2065-1"));
  EXPECT_NE(builtin().view_id({"ACEScg", "sRGB - Display", "ACES 1.0 - SDR Video"}),
            builtin().view_id({"ACEScg", "sRGB - Display", "Un-tone-mapped"}));
}

TEST(ColourConfig, ConfigsAreTakenInTheirOrderAndRefusedByName) {
  const TemporaryFolder folder;
  const auto own = folder.write("own.ocio",
                                "ocio_profile_version: 1\nroles: {default: mine}\ndisplays:\n  screen:\n"
                                "    - !<View> {name: plain, colorspace: mine}\n"
                                "colorspaces:\n  - !<ColorSpace> {name: mine}\n");
  const std::string good = own.string();
  EXPECT_TRUE(ColourConfig::load(good, "/nowhere").has_space("mine"));
  EXPECT_TRUE(ColourConfig::load(std::nullopt, good.c_str()).has_space("mine"));
  EXPECT_TRUE(ColourConfig::load(std::nullopt, "").has_space("ACEScg"));
  EXPECT_EQ(ColourConfig::load(good, nullptr).displays(), std::vector<std::string>{"screen"});

  const Refusal missing = refusal_of([] { ColourConfig::load("/nowhere/a.ocio", nullptr); });
  EXPECT_EQ(missing.code, ExitCode::BadInput);
  EXPECT_EQ(missing.line, "/nowhere/a.ocio: the OCIO config that colour.config names: no such file");
  EXPECT_EQ(refusal_of([] { ColourConfig::load(std::nullopt, "/nowhere/a.ocio"); }).line,
            "/nowhere/a.ocio: the OCIO config that $OCIO names: no such file");
  const auto broken = folder.write("broken.ocio", "ocio_profile_version: [\n");
  const Refusal refusal = refusal_of([&] { ColourConfig::load(broken.string(), nullptr); });
  EXPECT_EQ(refusal.code, ExitCode::BadInput);
  EXPECT_THAT(refusal.line, HasSubstr("broken.ocio: the OCIO config that colour.config names: "));
  EXPECT_EQ(refusal.line.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace lensplane
