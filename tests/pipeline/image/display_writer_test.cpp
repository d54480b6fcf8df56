// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/display_writer.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstring>

#include "pipeline/colour/icc_profile.h"
#include "pipeline/image/image_reader.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

TEST(DisplayWriter, ClampsAndKeepsBlackBlack) {
  const TemporaryFolder folder;
  Picture picture{64, 1, 0, 0, 64, 1, {}};
  for (int i = 0; i < 64; ++i) picture.pixels.push_back({-1.0F, 2.0F, 0.0F, 1.0F});
  write_display(folder / "a.png", picture, 8, {"p"});
  const EncodedImage image = read_image(folder / "a.png");
  ASSERT_EQ(image.type, SampleType::UInt8);
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_EQ(static_cast<int>(image.samples[4 * i]), 0);
    EXPECT_EQ(static_cast<int>(image.samples[4 * i + 1]), 255);
    EXPECT_EQ(static_cast<int>(image.samples[4 * i + 2]), 0);
  }
}

TEST(DisplayWriter, DithersWithoutShiftingTheMean) {
  const TemporaryFolder folder;
  Picture picture{128, 128, 0, 0, 128, 128, {}};
  picture.pixels.assign(128 * 128, Rgba{100.3F / 255, 100.3F / 255, 100.3F / 255, 1});
  write_display(folder / "a.png", picture, 8, {"p"});
  const EncodedImage image = read_image(folder / "a.png");
  double sum = 0;
  for (std::size_t i = 0; i < 128 * 128; ++i) sum += static_cast<int>(image.samples[4 * i]);
  EXPECT_NEAR(sum / (128 * 128), 100.3, 0.02);
}

TEST(DisplayWriter, DithersAsOpenImageIODoes) {
  const TemporaryFolder folder;
  Picture picture{90, 70, 0, 0, 90, 70, {}};  // more rows than one thread takes
  for (int i = 0; i < 90 * 70; ++i) {
    const auto v = static_cast<float>(i) / 6000.0F - 0.02F;
    picture.pixels.push_back({v, 1 - v, 0.1F * v, 1});
  }
  write_display(folder / "ours.png", picture, 8, {"p"});
  OIIO::ImageSpec spec(90, 70, 3, OIIO::TypeDesc::UINT8);
  spec["oiio:dither"] = 1;
  const auto output = OIIO::ImageOutput::create("theirs.png");
  ASSERT_TRUE(output->open(folder / "theirs.png", spec));
  output->write_image(OIIO::TypeDesc::FLOAT, picture.pixels.data(), sizeof(Rgba));
  output->close();
  EXPECT_EQ(read_image(folder / "ours.png").samples, read_image(folder / "theirs.png").samples);
}

TEST(DisplayWriter, SixteenBitsAreRoundedAndClamped) {
  const TemporaryFolder folder;
  const Picture picture{
      2, 1, 0, 0, 2, 1, {{0.5F, 12345.4F / 65535, 1.5F, 1}, {-0.1F, 12345.6F / 65535, 0, 1}}};
  for (const char* name : {"a.png", "a.tif"}) {
    write_display(folder / name, picture, 16, {"p", "g24_rec709_display", {}});
    const EncodedImage image = read_image(folder / name);
    ASSERT_EQ(image.type, SampleType::UInt16) << name;
    std::array<std::uint16_t, 8> codes{};
    std::memcpy(codes.data(), image.samples.data(), sizeof codes);
    EXPECT_EQ(codes, (std::array<std::uint16_t, 8>{32768, 12345, 65535, 65535, 0, 12346, 0, 65535})) << name;
  }
}

TEST(DisplayWriter, FilesSayWhatTheirColoursAre) {
  const TemporaryFolder folder;
  const Picture picture{8, 4, 0, 0, 8, 4, UnsetVector<Rgba>(32, Rgba{0.5F, 0.25F, 0.1F, 1})};
  const auto icc_size = [](const std::filesystem::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    const auto* profile = input->spec().find_attribute("ICCProfile");
    return profile ? profile->type().size() : 0;
  };
  const std::vector<unsigned char> icc = icc_profile("g26_p3d65_display");
  for (const char* name : {"a.png", "a.tif"}) {
    write_display(folder / name, picture, 16, {"p", "g26_p3d65_display", icc});
    EXPECT_EQ(icc_size(folder / name), icc.size()) << name;
  }
  EXPECT_EQ(read_interop_id(folder / "a.png"), "g26_p3d65_display");
  write_display(folder / "s.png", picture, 8,
                {"p", "srgb_rec709_display", icc_profile("srgb_rec709_display")});
  EXPECT_EQ(
      OIIO::ImageInput::open((folder / "s.png").string())->spec().get_string_attribute("oiio:ColorSpace"),
      "sRGB");
  EXPECT_EQ(icc_size(folder / "s.png"), 0);
}

TEST(DisplayWriter, ParametersComeBackFromWholeFilesOnly) {
  const TemporaryFolder folder;
  const Picture picture{40, 30, 0, 0, 40, 30, UnsetVector<Rgba>(1200, Rgba{0.5F, 0.25F, 0.1F, 1})};
  for (const char* name : {"a.png", "a.tif"}) {
    const auto path = folder / name;
    write_display(path, picture, 16, {"ABC123"});
    EXPECT_EQ(read_display_parameters(path), "ABC123");
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 20);
    EXPECT_EQ(read_display_parameters(path), std::nullopt);
  }
  EXPECT_EQ(read_display_parameters(folder / "none.png"), std::nullopt);
}

}  // namespace
}  // namespace lensplane
