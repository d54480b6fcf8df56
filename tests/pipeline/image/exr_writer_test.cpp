// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/exr_writer.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "pipeline/image/image_reader.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

ExrHeader example_header() {
  ExrHeader header;
  header.shot = "example";
  header.frame = 1007;
  header.plan = "shinotsuka-makino: weak law, 3 sources on 3 planes";
  header.parameters = "ABCDEF";
  header.colour_interop = "lin_ap1_scene";
  header.chromaticities =
      Chromaticities{{{.713F, .293F}, {.165F, .830F}, {.128F, .044F}, {.32168F, .33767F}}};
  header.fps = {24000, 1001};
  header.camera_position = Vec3(10, 20, 30);
  return header;
}

std::vector<float> ramp(std::size_t count) {
  std::vector<float> samples(count);
  for (std::size_t i = 0; i < count; ++i) samples[i] = static_cast<float>(i) / 3.0F;
  return samples;
}

TEST(ExrWriter, HeaderSaysWhatTheContractAsksFor) {
  const TemporaryFolder folder;
  const auto samples = ramp(12);
  write_exr(folder / "a.exr", {4, 3, 0}, {{"R", samples.data()}}, {PixelType::Float, ExrCompression::Zip},
            example_header());
  const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
  ASSERT_TRUE(input);
  const OIIO::ImageSpec& spec = input->spec();
  EXPECT_EQ(spec.get_string_attribute("lensplane:version"), "0.1.0");
  EXPECT_EQ(spec.get_string_attribute("lensplane:shot"), "example");
  EXPECT_EQ(spec.get_int_attribute("lensplane:frame"), 1007);
  EXPECT_EQ(spec.get_string_attribute("lensplane:plan"), example_header().plan);
  EXPECT_EQ(spec.get_string_attribute("lensplane:parameters"), "ABCDEF");
  EXPECT_EQ(spec.get_string_attribute("lensplane:st_origin"), "bottom left");
  EXPECT_EQ(spec.get_string_attribute("colorInteropID"), "lin_ap1_scene");
  EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
  const auto* fps = spec.find_attribute("framesPerSecond");
  ASSERT_TRUE(fps);
  EXPECT_EQ(static_cast<const int*>(fps->data())[0], 24000);
  EXPECT_EQ(static_cast<const int*>(fps->data())[1], 1001);
  const auto* matrix = spec.find_attribute("worldToCamera");
  ASSERT_TRUE(matrix);
  EXPECT_EQ(static_cast<const float*>(matrix->data())[12], -10);
  EXPECT_EQ(static_cast<const float*>(matrix->data())[14], -30);
  EXPECT_TRUE(spec.find_attribute("chromaticities"));
  for (const char* leak : {"Software", "DateTime", "capDate", "HostComputer", "owner", "Exif:ImageHistory"}) {
    EXPECT_FALSE(spec.find_attribute(leak)) << leak;
  }
}

TEST(ExrWriter, WorldToCameraTurnsTheWorldIntoCameraAxes) {
  const TemporaryFolder folder;
  const auto samples = ramp(1);
  ExrHeader header = example_header();
  header.camera_axes = basis_from_zxy({0.3, 0.7, -0.2});
  write_exr(folder / "a.exr", {1, 1, 0}, {{"R", samples.data()}}, {PixelType::Float, ExrCompression::Zip},
            header);
  const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
  const auto* m = static_cast<const float*>(input->spec().find_attribute("worldToCamera")->data());
  const Vec3 point(1, -2, 5);
  const Vec3 expected = header.camera_axes.local_from_parent(point - header.camera_position);
  for (int k = 0; k < 3; ++k) {
    const double got = point.x * m[k] + point.y * m[4 + k] + point.z * m[8 + k] + m[12 + k];
    EXPECT_NEAR(got, expected[k], 1e-5);
  }
}

TEST(ExrWriter, OverscanLiesAroundTheDisplayWindow) {
  const TemporaryFolder folder;
  const auto samples = ramp(8 * 7);
  write_exr(folder / "a.exr", {4, 3, 2}, {{"Y", samples.data()}}, {PixelType::Float, ExrCompression::Zip},
            example_header());
  const EncodedImage image = read_image(folder / "a.exr");
  EXPECT_EQ(image.width, 8);
  EXPECT_EQ(image.height, 7);
  EXPECT_EQ(image.x, -2);
  EXPECT_EQ(image.y, -2);
  EXPECT_EQ(image.display_width, 4);
  EXPECT_EQ(image.display_height, 3);
  const auto* rgba = reinterpret_cast<const float*>(image.samples.data());
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(rgba[4 * i], samples[i]);
}

TEST(ExrWriter, HalfIsClampedToTheLargestHalf) {
  const TemporaryFolder folder;
  const std::vector<float> samples = {1e9F, -1e9F, 0.5F, 65504.0F};
  write_exr(folder / "a.exr", {2, 2, 0}, {{"R", samples.data()}}, {PixelType::Half, ExrCompression::Piz},
            example_header());
  std::vector<float> back(4);
  const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
  EXPECT_EQ(input->spec().format, OIIO::TypeDesc::HALF);
  ASSERT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, back.data()));
  EXPECT_EQ(back, (std::vector<float>{65504, -65504, 0.5, 65504}));
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(ExrWriter, PiecesMakeTheSameFileAsTheWhole) {
  const TemporaryFolder folder;
  constexpr int kWidth = 44, kHeight = 304;
  const auto samples = ramp(kWidth * kHeight);
  const ExrWindow window{40, 300, 2};
  for (const ExrCompression compression : {ExrCompression::Zip, ExrCompression::None, ExrCompression::Dwab}) {
    for (const PixelType type : {PixelType::Float, PixelType::Half}) {
      const ExrFormat format{type, compression};
      const std::size_t whole =
          write_exr(folder / "whole.exr", window, {{"R", samples.data()}}, format, example_header());
      ExrFile file(folder / "pieces.exr", window, {"R"}, format, example_header());
      const int rows[] = {64, 1, 128, kHeight - 193};
      const float* from = samples.data();
      for (const int count : rows) {
        file.write({{"R", from}}, count);
        from += kWidth * count;
      }
      EXPECT_FALSE(std::filesystem::exists(folder / "pieces.exr"));
      EXPECT_EQ(file.commit(), whole);
      EXPECT_EQ(std::filesystem::file_size(folder / "pieces.exr"), whole);
      EXPECT_TRUE(bytes_of(folder / "pieces.exr") == bytes_of(folder / "whole.exr"));
      std::filesystem::remove(folder / "pieces.exr");
    }
  }
}

TEST(ExrWriter, FileThatIsNotFinishedLeavesNothing) {
  const TemporaryFolder folder;
  const auto samples = ramp(64);
  {
    ExrFile file(folder / "a.exr", {8, 8, 0}, {"R"}, {PixelType::Float, ExrCompression::Zip},
                 example_header());
    file.write({{"R", samples.data()}}, 4);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ExrWriter, AttributesComeBackFromWholeFilesOnly) {
  const TemporaryFolder folder;
  const auto samples = ramp(64 * 64);
  const auto path = folder / "a.exr";
  write_exr(path, {64, 64, 0}, {{"R", samples.data()}}, {PixelType::Float, ExrCompression::Zip},
            example_header());
  EXPECT_EQ(read_exr_attribute(path, "parameters"), "ABCDEF");
  EXPECT_EQ(read_exr_attribute(path, "amplification"), std::nullopt);
  EXPECT_EQ(read_exr_attribute(folder / "none.exr", "parameters"), std::nullopt);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 20);
  EXPECT_EQ(read_exr_attribute(path, "parameters"), std::nullopt);
  folder.write("text.exr", "not an image");
  EXPECT_EQ(read_exr_attribute(folder / "text.exr", "parameters"), std::nullopt);
}

}  // namespace
}  // namespace lensplane
