// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/texture_store.h"
#include "pipeline/sequence/shot_colours.h"

#include <OpenImageIO/imagebuf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/image/display_writer.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/shot/example_shot.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

ColourConfig builtin() {
  return ColourConfig::load(std::nullopt, nullptr);
}

void write_grey(const std::filesystem::path& path, float value) {
  write_display(path, Picture{1, 1, 0, 0, 1, 1, {{value, value, value, 1}}}, 8, {});
}

TEST(TextureStore, KeepsStillsAndReadsSequencesByFrame) {
  const TemporaryFolder folder;
  write_grey(folder / "earth.png", 1);
  write_grey(folder / "bg.0001.png", 0);
  write_grey(folder / "bg.0002.png", 1);
  Shot shot = example_shot();
  shot.layers[0].image.pattern.text = (folder / "earth.png").string();
  shot.layers[1].image.pattern.text = (folder / "bg.####.png").string();
  const ColourConfig colours = builtin();
  TextureStore store(shot, colours);
  EXPECT_EQ(store.texture(0, 1), store.texture(0, 2));
  EXPECT_EQ(store.texture(1, 1)->lookup({0.5, 0.5})[0], 0);
  EXPECT_NEAR(store.texture(1, 2)->lookup({0.5, 0.5})[0], 1, 1e-4);
  EXPECT_NE(store.digest(1, 1), store.digest(1, 2));
  const Refusal missing = refusal_of([&] { store.texture(1, 3); });
  EXPECT_EQ(missing.code, ExitCode::BadInput);
  EXPECT_EQ(missing.line, "example.yaml:20:12: layers.background.image: " +
                              (folder / "bg.0003.png").string() + ": no such image");
  EXPECT_EQ(refusal_of([&] { store.digest(1, 3); }).code, ExitCode::BadInput);
}

TEST(TextureStore, AnotherFrameOrBlackStandsInForOneThatIsMissing) {
  const TemporaryFolder folder;
  write_grey(folder / "bg.0002.png", 0);
  write_grey(folder / "bg.0004.png", 1);
  const auto shot_with = [&](const std::string& missing) {
    return example_shot(
        {"layers.background.image={file: " + (folder / "bg.####.png").string() + missing + "}"});
  };
  const ColourConfig colours = builtin();
  const auto shown = [&](const Shot& shot, int frame) {
    TextureStore store(shot, colours);
    const auto stand_in = store.stand_in(1, frame);
    return std::pair(stand_in ? stand_in->frame.value_or(-1) : 0,
                     store.texture(1, frame)->lookup({0.5, 0.5}));
  };
  const Shot hold = shot_with(", missing: hold"), black = shot_with(", missing: black"),
             strict = shot_with(", missing: error");
  const Rgba first = shown(hold, 2).second, second = shown(hold, 4).second;
  ASSERT_NE(first, second);
  EXPECT_EQ(shown(hold, 2).first, 0);
  EXPECT_EQ(shown(hold, 1), std::pair(2, first));
  EXPECT_EQ(shown(hold, 3), std::pair(2, first));
  EXPECT_EQ(shown(hold, 9), std::pair(4, second));
  EXPECT_EQ(shown(black, 4), std::pair(0, second));
  EXPECT_EQ(shown(black, 3), std::pair(-1, Rgba{0, 0, 0, 0}));
  EXPECT_THAT(refusal_of([&] { shown(strict, 3); }).line, HasSubstr("bg.0003.png: no such image"));
  // A frame that turns up is another picture.
  const std::string held = TextureStore(hold, colours).digest(1, 3),
                    none = TextureStore(black, colours).digest(1, 3);
  EXPECT_EQ(held, TextureStore(hold, colours).digest(1, 2));
  write_grey(folder / "bg.0003.png", 0.5F);
  EXPECT_NE(TextureStore(hold, colours).digest(1, 3), held);
  EXPECT_NE(TextureStore(black, colours).digest(1, 3), none);
  EXPECT_EQ(shown(hold, 3).first, 0);
  for (const char* name : {"bg.0002.png", "bg.0003.png", "bg.0004.png"})
    std::filesystem::remove(folder / name);
  EXPECT_THAT(refusal_of([&] { shown(hold, 3); }).line, HasSubstr("bg.0003.png: no such image"));
  EXPECT_THAT(refusal_of([&] { example_shot({"layers.earth.image={file: a.png, missing: hold}"}); }).line,
              HasSubstr("missing: allowed: with a sequence only"));
}

TEST(TextureStore, ReadsTheLayerThatIsChosen) {
  const TemporaryFolder folder;
  const std::string path = (folder / "layers.exr").string();
  OIIO::ImageSpec spec(1, 1, 6, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B", "glow.R", "glow.G", "glow.B"};
  OIIO::ImageBuf image(spec);
  const float values[] = {0.1F, 0.1F, 0.1F, 0.7F, 0.7F, 0.7F};
  image.setpixel(0, 0, values);
  ASSERT_TRUE(image.write(path));
  const auto shot_with = [&](const std::string& choice) {
    return example_shot({"layers.earth.image={file: " + path + ", space: ACEScg" + choice + "}"});
  };
  const Shot own = shot_with(""), glow = shot_with(", layer: glow"),
             part = shot_with(", layer: glow, part: 0");
  const ColourConfig colours = builtin();
  TextureStore of_own(own, colours), of_glow(glow, colours), of_part(part, colours);
  EXPECT_NEAR(of_own.texture(0, 1)->lookup({0.5, 0.5})[0], 0.1, 1e-6);
  EXPECT_NEAR(of_glow.texture(0, 1)->lookup({0.5, 0.5})[0], 0.7, 1e-6);
  EXPECT_NEAR(of_part.texture(0, 1)->lookup({0.5, 0.5})[0], 0.7, 1e-6);
  EXPECT_NE(of_own.digest(0, 1), of_glow.digest(0, 1));
  const Shot none = shot_with(", layer: fog");
  EXPECT_THAT(refusal_of([&] { TextureStore(none, colours).texture(0, 1); }).line,
              HasSubstr("it has no layer \"fog\" with R, G, B or Y; its layers: glow"));
}

TEST(TextureStore, NightIsAnImageOfItsOwn) {
  const TemporaryFolder folder;
  write_grey(folder / "day.png", 1);
  write_grey(folder / "night.png", 0);
  folder.write("stars.csv", "Sirius");
  const auto at = [&](const char* name) { return (folder / name).string(); };
  const auto shot_with = [&](const std::string& night) {
    Shot shot = example_shot(
        {"layers.earth.light=[1, 0, 0]", "layers.earth.image=" + at("day.png"), "layers.earth.night=" + night,
         "layers.background={name: s, type: stars, catalogue: " + at("stars.csv") + "}"});
    return shot;
  };
  const ColourConfig colours = builtin();
  const Shot both = shot_with(at("night.png")), day = shot_with("null"), missing = shot_with(at("none.png"));
  TextureStore store(both, colours), day_store(day, colours), missing_store(missing, colours);
  EXPECT_NEAR(store.texture(0, 1)->lookup({0.5, 0.5})[0], 1, 1e-4);
  EXPECT_EQ(store.night(0, 1)->lookup({0.5, 0.5})[0], 0);
  EXPECT_EQ(store.night(0, 1), store.night(0, 2));
  EXPECT_EQ(day_store.night(0, 1), nullptr);
  EXPECT_NE(store.digest(0, 1), day_store.digest(0, 1));
  EXPECT_THAT(refusal_of([&] { missing_store.night(0, 1); }).line, HasSubstr("layers.earth.night: "));
  EXPECT_EQ(refusal_of([&] { missing_store.digest(0, 1); }).code, ExitCode::BadInput);
  // Stars have no image, but a file that their picture depends on.
  const std::string before = store.digest(1, 1);
  folder.write("stars.csv", "Vega");
  EXPECT_NE(day_store.digest(1, 1), before);
}

TEST(TextureStore, ColoursThatTheConfigDoesNotHaveAreRefusedWithTheirPlace) {
  const auto line = [](const std::string& setting) {
    return refusal_of([&] { check_colours(example_shot({setting}), builtin()); }).line;
  };
  EXPECT_EQ(line("colour.working=ACEScg"), "");
  EXPECT_THAT(line("colour.working=AcesCG2"),
              HasSubstr("--set colour.working:1:1: colour.working: \"AcesCG2\" is no colour space of the "
                        "OCIO config; allowed: "
                        "sRGB - Display"));
  EXPECT_THAT(line("colour.working=sRGB - Texture"),
              HasSubstr("is not linear; allowed: scene-linear spaces"));
  EXPECT_THAT(line("colour.display=Laser"),
              HasSubstr("is no display of the OCIO config; allowed: sRGB - Display"));
  EXPECT_THAT(line("colour.view=Filmic"),
              HasSubstr("is no view of this display of the OCIO config; allowed: ACES 1.0"));
  EXPECT_THAT(line("layers.earth.image={file: e.png, space: foo}"),
              HasSubstr("layers.earth.image.space: \"foo\" is no"));
}

}  // namespace
}  // namespace lensplane
