// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/image_reader.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <numeric>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

template <class Sample>
void write(const std::filesystem::path& path, OIIO::ImageSpec spec, const std::vector<Sample>& samples) {
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output);
  ASSERT_TRUE(output->open(path.string(), spec));
  ASSERT_TRUE(output->write_image(spec.format, samples.data()));
  ASSERT_TRUE(output->close());
}

TEST(ImageReader, StraightAlphaStaysAsItIsStored) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(1, 1, 4, OIIO::TypeDesc::UINT8);
  spec["oiio:UnassociatedAlpha"] = 1;
  write<std::uint8_t>(folder / "a.png", spec, {200, 100, 50, 128});
  const EncodedImage image = read_image(folder / "a.png");
  EXPECT_TRUE(image.has_alpha);
  EXPECT_FALSE(image.premultiplied);
  EXPECT_EQ(image.type, SampleType::UInt8);
  EXPECT_EQ(static_cast<int>(image.samples[0]), 200);
  EXPECT_EQ(static_cast<int>(image.samples[3]), 128);
}

TEST(ImageReader, GreyHasThreeEqualColoursAndFullAlpha) {
  const TemporaryFolder folder;
  write<std::uint16_t>(folder / "a.png", OIIO::ImageSpec(1, 1, 1, OIIO::TypeDesc::UINT16), {1234});
  const EncodedImage image = read_image(folder / "a.png");
  ASSERT_EQ(image.type, SampleType::UInt16);
  const auto* rgba = reinterpret_cast<const std::uint16_t*>(image.samples.data());
  EXPECT_EQ(rgba[0], 1234);
  EXPECT_EQ(rgba[2], 1234);
  EXPECT_EQ(rgba[3], 65535);
  EXPECT_FALSE(image.has_alpha);
}

TEST(ImageReader, ChannelsAreFoundByTheirNames) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(1, 1, 5, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Z", "B", "G", "R", "A"};
  spec.alpha_channel = 4;
  write<float>(folder / "a.exr", spec, {9, 3, 2, 1, 0.5});
  const EncodedImage image = read_image(folder / "a.exr");
  const auto* rgba = reinterpret_cast<const float*>(image.samples.data());
  EXPECT_EQ(rgba[0], 1);
  EXPECT_EQ(rgba[1], 2);
  EXPECT_EQ(rgba[2], 3);
  EXPECT_EQ(rgba[3], 0.5);
  EXPECT_TRUE(image.premultiplied);
}

TEST(ImageReader, RefusesWhatIsMissingOrBrokenByName) {
  const TemporaryFolder folder;
  const auto line_and_code = [](const std::filesystem::path& path) {
    return refusal_of([&] { read_image(path); });
  };
  EXPECT_EQ(line_and_code(folder / "none.exr").line, (folder / "none.exr").string() + ": no such image");
  EXPECT_EQ(line_and_code(folder / "none.exr").code, ExitCode::BadInput);
  const Refusal text = line_and_code(folder.write("text.exr", "not an image"));
  EXPECT_EQ(text.code, ExitCode::BadInput);
  EXPECT_THAT(text.line, HasSubstr("text.exr: cannot be read as an image: "));
  EXPECT_THAT(line_and_code(folder.write("odd.xyz", "?")).line,
              HasSubstr("odd.xyz: cannot be read as an image: "));

  OIIO::ImageSpec depth(1, 1, 1, OIIO::TypeDesc::FLOAT);
  depth.channelnames = {"Z"};
  write<float>(folder / "z.exr", depth, {1});
  EXPECT_THAT(line_and_code(folder / "z.exr").line, HasSubstr("it has no channels R, G, B or Y"));
  // A header that promises more than there is.
  const char header[] = "P6 60000 60000 255\n";
  EXPECT_THAT(line_and_code(folder.write("large.ppm", header)).line,
              HasSubstr("60000 x 60000 pixels; allowed: up to 512"));

  OIIO::ImageSpec spec(64, 64, 3, OIIO::TypeDesc::HALF);
  write<std::uint16_t>(folder / "cut.exr", spec, std::vector<std::uint16_t>(64 * 64 * 3, 0x3c01));
  std::filesystem::resize_file(folder / "cut.exr", std::filesystem::file_size(folder / "cut.exr") / 2);
  const Refusal cut = line_and_code(folder / "cut.exr");
  EXPECT_EQ(cut.code, ExitCode::BadInput);
  EXPECT_EQ(cut.line.find('\n'), std::string::npos);
}

/// One pixel, whose channels hold 1, 2, 3, ... in the order of `channels`.
OIIO::ImageSpec spec_of(const std::vector<std::string>& channels) {
  OIIO::ImageSpec spec(1, 1, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = channels;
  return spec;
}

std::vector<float> counted(const OIIO::ImageSpec& spec) {
  std::vector<float> values(static_cast<std::size_t>(spec.nchannels));
  std::iota(values.begin(), values.end(), 1.0F);
  return values;
}

void write_counted(const std::filesystem::path& path, const std::vector<std::string>& channels) {
  write<float>(path, spec_of(channels), counted(spec_of(channels)));
}

std::array<float, 4> colour_of(const EncodedImage& image) {
  std::array<float, 4> colour{};
  EXPECT_EQ(image.type, SampleType::Float);
  EXPECT_EQ(image.samples.size(), sizeof colour);
  std::memcpy(colour.data(), image.samples.data(), sizeof colour);
  return colour;
}

using Colour = std::array<float, 4>;

TEST(ImageReader, ReadsTheLayerThatIsChosen) {
  const TemporaryFolder folder;
  const auto path = folder / "layers.exr";
  write_counted(path, {"R", "G", "B", "A", "Z", "diffuse.R", "diffuse.G", "diffuse.B", "View.spec.r",
                       "View.spec.g", "View.spec.b", "View.spec.a", "mask.Y"});
  EXPECT_EQ(colour_of(read_image(path)), (Colour{1, 2, 3, 4}));
  EXPECT_EQ(colour_of(read_image(path, {"diffuse", ""})), (Colour{6, 7, 8, 4}));  // with the part's alpha
  EXPECT_EQ(colour_of(read_image(path, {"View.spec", ""})), (Colour{9, 10, 11, 12}));
  EXPECT_EQ(colour_of(read_image(path, {"mask", ""})), (Colour{13, 13, 13, 4}));
  const Refusal refusal = refusal_of([&] { read_image(path, {"specular", ""}); });
  EXPECT_EQ(refusal.line, path.string() +
                              ": cannot be read as an image: it has no layer \"specular\" with R, G, B or Y; "
                              "its layers: View.spec, diffuse, mask");
}

TEST(ImageReader, AlphaIsNotThatOfAnotherLayer) {
  const TemporaryFolder folder;
  write_counted(folder / "a.exr", {"R", "G", "B", "spec.R", "spec.G", "spec.B", "spec.A"});
  EXPECT_EQ(colour_of(read_image(folder / "a.exr")), (Colour{1, 2, 3, 1}));
  EXPECT_FALSE(read_image(folder / "a.exr").has_alpha);
}

TEST(ImageReader, TellsTheLayersOfAnImageWithoutColoursOfItsOwn) {
  const TemporaryFolder folder;
  write_counted(folder / "blender.exr",
                {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B",
                 "ViewLayer.Combined.A", "ViewLayer.Depth.Z"});
  EXPECT_THAT(refusal_of([&] { read_image(folder / "blender.exr"); }).line,
              HasSubstr("it has no channels R, G, B or Y; its layers: ViewLayer.Combined, ViewLayer.Depth"));
  EXPECT_EQ(colour_of(read_image(folder / "blender.exr", {"ViewLayer.Combined", ""})), (Colour{1, 2, 3, 4}));
  EXPECT_THAT(refusal_of([&] {
                read_image(folder / "blender.exr", {"ViewLayer.Depth", ""});
              }).line,
              HasSubstr("no layer \"ViewLayer.Depth\" with R, G, B or Y"));
}

TEST(ImageReader, ReadsThePartThatIsChosen) {
  const TemporaryFolder folder;
  const auto path = folder / "parts.exr";
  OIIO::ImageSpec specs[] = {spec_of({"R", "G", "B", "A"}),
                             spec_of({"R", "G", "B", "diffuse.R", "diffuse.G", "diffuse.B"})};
  specs[0]["oiio:subimagename"] = "beauty";
  specs[1]["oiio:subimagename"] = "light";
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output->open(path.string(), 2, specs));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, counted(specs[0]).data()));
  ASSERT_TRUE(output->open(path.string(), specs[1], OIIO::ImageOutput::AppendSubimage));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, counted(specs[1]).data()));
  ASSERT_TRUE(output->close());
  EXPECT_EQ(colour_of(read_image(path)), (Colour{1, 2, 3, 4}));
  EXPECT_EQ(colour_of(read_image(path, {"", "beauty"})), (Colour{1, 2, 3, 4}));
  EXPECT_EQ(colour_of(read_image(path, {"", "light"})), (Colour{1, 2, 3, 1}));
  EXPECT_EQ(colour_of(read_image(path, {"diffuse", "light"})), (Colour{4, 5, 6, 1}));
  EXPECT_EQ(colour_of(read_image(path, {"diffuse", "1"})), (Colour{4, 5, 6, 1}));
  EXPECT_THAT(refusal_of([&] {
                read_image(path, {"", "fog"});
              }).line,
              HasSubstr("it has no part \"fog\"; its parts: beauty, light"));
  write_counted(folder / "one.exr", {"R", "G", "B"});
  EXPECT_THAT(refusal_of([&] {
                read_image(folder / "one.exr", {"", "fog"});
              }).line,
              HasSubstr("it has no part \"fog\"; its parts: 0"));
}

}  // namespace
}  // namespace lensplane
