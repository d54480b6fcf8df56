// SPDX-License-Identifier: Apache-2.0
//
// Colours of whole shots, held against oiiotool with the same OpenColorIO config.

#include <OpenImageIO/imagebuf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/colour/colour_config.h"
#include "pipeline/image/display_writer.h"
#include "tests/end_to_end/read_picture.h"
#include "tests/end_to_end/run_program.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

constexpr const char* kConfig = LENSPLANE_SOURCE_DIR "/pipeline/colour/lensplane-aces.ocio";

/// Largest difference of two 16-bit pictures, in codes.
int largest_difference(const std::filesystem::path& a, const std::filesystem::path& b) {
  const OIIO::ImageBuf left = read_picture(a), right = read_picture(b);
  EXPECT_EQ(left.nativespec().format, OIIO::TypeDesc::UINT16);
  EXPECT_EQ(right.nativespec().format, OIIO::TypeDesc::UINT16);
  EXPECT_EQ(left.spec().width, right.spec().width);
  EXPECT_EQ(left.spec().height, right.spec().height);
  int largest = 0;
  for (int y = 0; y < left.spec().height; ++y) {
    for (int x = 0; x < left.spec().width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double off = std::abs(left.getchannel(x, y, 0, c) - right.getchannel(x, y, 0, c));
        largest = std::max(largest, static_cast<int>(std::lround(off * 65535)));
      }
    }
  }
  return largest;
}

/// Grey from far below to far above what a display shows, and colours of all kinds, some of them impossible.
Picture ramp_and_colours() {
  Picture picture{256, 9, 0, 0, 256, 9, {}};
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const float value = std::exp2(static_cast<float>(column) / 12 - 12);
      const auto lift = [&](int bit) { return (row >> bit) % 2 != 0 ? value : 0.25F * value; };
      Rgba pixel{lift(0), lift(1), lift(2), 1};
      if (row == 8) pixel = {-value, 0.5F * value, value / 64 - 1, 1};
      picture.pixels.push_back(pixel);
    }
  }
  return picture;
}

TEST(Colour, EveryViewIsOiiotoolsToOneCodeOfSixteenBits) {
  const TemporaryFolder folder;
  const Picture picture = ramp_and_colours();
  OIIO::ImageBuf linear(OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeDesc::FLOAT));
  for (OIIO::ImageBuf::Iterator<float> p(linear); !p.done(); ++p) {
    for (int c = 0; c < 3; ++c) p[c] = picture.at(p.x(), p.y())[static_cast<std::size_t>(c)];
  }
  ASSERT_TRUE(linear.write((folder / "linear.exr").string()));
  const ColourConfig colours = ColourConfig::load(std::nullopt, nullptr);
  int views = 0;
  for (const std::string& display : colours.displays()) {
    for (const std::string& view : colours.views(display)) {
      write_display(folder / "ours.tif", colours.to_display(picture, {"ACEScg", display, view}), 16, {});
      const ProgramResult theirs = run_program(
          {"oiiotool", "--colorconfig", kConfig, (folder / "linear.exr").string(), "--iscolorspace", "ACEScg",
           "--ociodisplay", display, view, "-d", "uint16", "-o", (folder / "theirs.tif").string()});
      ASSERT_EQ(theirs.exit_code, 0) << theirs.out << theirs.err;
      EXPECT_LE(largest_difference(folder / "ours.tif", folder / "theirs.tif"), 1) << display << " " << view;
      ++views;
    }
  }
  EXPECT_GE(views, 12);
}

constexpr const char* kShot = R"(lensplane: 1
shot: grade
frames: 1
camera: {resolution: [256, 9], fov: 40 deg}
layers:
  - {name: bg, type: plate, image: linear.exr}
colour: {view: Un-tone-mapped, grade: {cdl: warm.cc}}
output: {directory: ., image: {type: float}, maps: none, review: tiff16}
)";

constexpr const char* kWarm = R"(<ColorCorrection id="warm"><SOPNode><Slope>1.2 1 0.8</Slope>
<Offset>0.01 0 0</Offset><Power>1 1 1</Power></SOPNode></ColorCorrection>)";

/// The review of a shot in 16 bits, graded, is what oiiotool makes of the shot's linear picture.
TEST(Colour, ReviewsOfSixteenBitsAreOiiotoolsWithTheGrade) {
  const TemporaryFolder folder;
  OIIO::ImageBuf linear(OIIO::ImageSpec(256, 9, 3, OIIO::TypeDesc::FLOAT));
  for (OIIO::ImageBuf::Iterator<float> p(linear); !p.done(); ++p) {
    p[0] = static_cast<float>(p.x()) / 200;
    p[1] = 0.02F * static_cast<float>(p.y());
    p[2] = 0.5F - static_cast<float>(p.x()) / 300;
  }
  ASSERT_TRUE(linear.write((folder / "linear.exr").string()));
  const auto shot = folder.write("grade.yaml", kShot);
  folder.write("warm.cc", kWarm);
  ASSERT_EQ(lensplane({"render", shot.string(), "--quiet"}).err, "");
  const ProgramResult theirs =
      run_program({"oiiotool", "--colorconfig", kConfig, (folder / "grade.0001.exr").string(), "--ch",
                   "R,G,B", "--iscolorspace", "ACEScg", "--ociofiletransform", (folder / "warm.cc").string(),
                   "--iscolorspace", "ACEScg", "--ociodisplay", "sRGB - Display", "Un-tone-mapped", "-d",
                   "uint16", "-o", (folder / "theirs.tif").string()});
  ASSERT_EQ(theirs.exit_code, 0) << theirs.out << theirs.err;
  EXPECT_LE(largest_difference(folder / "grade.review.0001.tif", folder / "theirs.tif"), 1);
  // Without the grade it is another picture, made anew.
  const ProgramResult plain = lensplane({"render", shot.string(), "--set", "colour.grade=null"});
  EXPECT_THAT(plain.out, testing::Not(HasSubstr("already done")));
  EXPECT_GT(largest_difference(folder / "grade.review.0001.tif", folder / "theirs.tif"), 100);
  EXPECT_THAT(lensplane({"render", shot.string(), "--set", "colour.grade=null"}).out,
              HasSubstr("already done"));
}

TEST(Colour, GradesAndSpacesThatAreNotThereAreRefusedInOneLine) {
  const TemporaryFolder folder;
  OIIO::ImageBuf plate(OIIO::ImageSpec(4, 4, 3, OIIO::TypeDesc::HALF));
  plate.specmod()["colorInteropID"] = "lin_moon_scene";
  ASSERT_TRUE(plate.write((folder / "linear.exr").string()));
  const auto shot = folder.write("grade.yaml", kShot);
  const ProgramResult missing = lensplane({"check", shot.string()});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err,
            shot.string() + ":7:45: colour.grade.cdl: " + (folder / "warm.cc").string() + ": no such file\n");
  const ProgramResult unknown = lensplane({"render", shot.string(), "--set", "colour.grade=null"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("layers.bg.image: "));
  EXPECT_THAT(unknown.err, HasSubstr("its colorInteropID \"lin_moon_scene\" is no colour space"));
  const ProgramResult said =
      lensplane({"render", shot.string(), "--set", "colour.grade=null", "--set", "output.review=none",
                 "--set", "layers.bg.image={file: linear.exr, space: ACEScg}", "--quiet"});
  EXPECT_EQ(said.err, "");
}

}  // namespace
}  // namespace lensplane
