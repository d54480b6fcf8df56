// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/png_writer.h"

#include <gtest/gtest.h>

#include "pipeline/image/image_reader.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

TEST(PngWriter, ClampsAndKeepsBlackBlack) {
  const TemporaryFolder folder;
  Picture picture{64, 1, 0, 0, 64, 1, {}};
  for (int i = 0; i < 64; ++i) picture.pixels.push_back({-1.0F, 2.0F, 0.0F, 1.0F});
  write_png(folder / "a.png", picture, {"p"});
  const EncodedImage image = read_image(folder / "a.png");
  ASSERT_EQ(image.type, SampleType::UInt8);
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_EQ(static_cast<int>(image.samples[4 * i]), 0);
    EXPECT_EQ(static_cast<int>(image.samples[4 * i + 1]), 255);
    EXPECT_EQ(static_cast<int>(image.samples[4 * i + 2]), 0);
  }
}

TEST(PngWriter, DithersWithoutShiftingTheMean) {
  const TemporaryFolder folder;
  Picture picture{128, 128, 0, 0, 128, 128, {}};
  picture.pixels.assign(128 * 128, Rgba{100.3F / 255, 100.3F / 255, 100.3F / 255, 1});
  write_png(folder / "a.png", picture, {"p"});
  const EncodedImage image = read_image(folder / "a.png");
  double sum = 0;
  for (std::size_t i = 0; i < 128 * 128; ++i) sum += static_cast<int>(image.samples[4 * i]);
  EXPECT_NEAR(sum / (128 * 128), 100.3, 0.02);
}

TEST(PngWriter, ParametersComeBackFromWholeFilesOnly) {
  const TemporaryFolder folder;
  Picture picture{40, 30, 0, 0, 40, 30, std::vector<Rgba>(1200, Rgba{0.5F, 0.25F, 0.1F, 1})};
  const auto path = folder / "a.png";
  write_png(path, picture, {"ABC123"});
  EXPECT_EQ(read_png_parameters(path), "ABC123");
  EXPECT_EQ(read_png_parameters(folder / "none.png"), std::nullopt);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_EQ(read_png_parameters(path), std::nullopt);
}

}  // namespace
}  // namespace lensplane
