// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/tiled_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/image/display_writer.h"
#include "tests/pipeline/composite/reference_filter.h"
#include "tests/pipeline/composite/tiled_file.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

constexpr std::size_t kCacheBytes = std::size_t{16} << 20;

Picture numbered(int width, int height) {
  return painted(width, height, [](int column, int row) {
    return Rgba{static_cast<float>(column), static_cast<float>(row), 0, 0.5F};
  });
}

TEST(TiledImage, TilesAreTheFilesPixels) {
  const TemporaryFolder folder;
  write_tiled(folder / "numbered.tx", numbered(100, 70), 32);
  const auto file = open_tiled_image(folder / "numbered.tx", kCacheBytes);
  const TiledImage& image = *file;
  ASSERT_EQ(image.levels().size(), 7);
  EXPECT_EQ(image.levels()[1].width, 50);
  EXPECT_EQ(image.levels()[6].height, 1);
  const EncodedImage last = image.tile(0, 3, 2);
  EXPECT_EQ(last.width, 4);
  EXPECT_EQ(last.height, 6);
  EXPECT_TRUE(last.has_alpha);
  EXPECT_TRUE(last.premultiplied);
  EXPECT_EQ(float_pixels(last).at(3, 5), (Rgba{99, 69, 0, 0.5F}));
  EXPECT_EQ(float_pixels(image.tile(1, 0, 0)).at(3, 5), (Rgba{6.5F, 10.5F, 0, 0.5F}));
}

TEST(TiledImage, ReadsTheLayerThatIsChosen) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(64, 48, 7, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B", "A", "diffuse.R", "diffuse.G", "diffuse.B"};
  OIIO::ImageBuf layers(spec);
  for (OIIO::ImageBuf::Iterator<float> p(layers); !p.done(); ++p) {
    p[3] = 0.5F;
    p[4] = static_cast<float>(p.x());
    p[5] = static_cast<float>(p.y());
    p[6] = 7;
  }
  write_tiled(folder / "layers.exr", layers, 32);
  const auto image = open_tiled_image(folder / "layers.exr", kCacheBytes, {"diffuse", ""});
  EXPECT_EQ(float_pixels(image->tile(0, 1, 1)).at(3, 5), (Rgba{35, 37, 7, 0.5F}));
  EXPECT_EQ(float_pixels(image->tile(1, 0, 0)).at(3, 5), (Rgba{6.5F, 10.5F, 7, 0.5F}));
  EXPECT_THAT(refusal_of([&] {
                open_tiled_image(folder / "layers.exr", kCacheBytes, {"", "fog"});
              }).line,
              HasSubstr("it has no part"));
}

TEST(TiledImage, WhatHasNoTilesIsRefusedWithTheWayOut) {
  const TemporaryFolder folder;
  const std::string path = (folder / "plain.png").string();
  write_display(path, numbered(10, 10), 8, {});
  const Refusal refusal = refusal_of([&] { open_tiled_image(path, kCacheBytes); });
  EXPECT_EQ(refusal.code, ExitCode::BadInput);
  EXPECT_EQ(refusal.line,
            path +
                ": cannot be read tile by tile: 10 x 10 pixels, but not both in tiles and in smaller "
                "sizes, too; make a file that is so: maketx " +
                path + " -o FILE.tx");
  EXPECT_THAT(refusal_of([&] { open_tiled_image(folder / "none.tx", kCacheBytes); }).line,
              HasSubstr("none.tx: cannot be read tile by tile: "));
}

TEST(TiledImage, SmallImagesFitIntoMemory) {
  const TemporaryFolder folder;
  write_display(folder / "plain.png", numbered(10, 10), 8, {});
  EXPECT_FALSE(is_larger_than_memory(folder / "plain.png"));
  EXPECT_THAT(refusal_of([&] { is_larger_than_memory(folder / "none.png"); }).line,
              HasSubstr("none.png: no such image"));
}

}  // namespace
}  // namespace lensplane
