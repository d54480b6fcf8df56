// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/image_reader.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace lensplane
