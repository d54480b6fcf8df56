// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/image_rates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/image/exr_writer.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

void write_frame(const std::filesystem::path& path, Rational fps) {
  const float pixel = 0.5F;
  ExrHeader header;
  header.fps = fps;
  write_exr(path, {1, 1, 0}, {{"R", &pixel}}, {}, header);
}

TEST(ImageRates, AreToldWhereTheyAreOthers) {
  const TemporaryFolder folder;
  Shot shot;
  shot.fps = {24, 1};
  Layer layer{"bg", {}, PlateLayer{}};
  layer.image.pattern.text = (folder / "bg.####.exr").string();
  shot.layers = {layer};
  EXPECT_THAT(other_rates(shot, {1, 2}), IsEmpty()) << "no file";
  write_frame(folder / "bg.0002.exr", {25, 1});
  EXPECT_THAT(
      other_rates(shot, {1, 2}),
      ElementsAre(
          "layer bg: its images say 25 frames per second, the shot 24; they are shown frame by frame"));
  EXPECT_THAT(other_rates(shot, {1}), IsEmpty());
  write_frame(folder / "bg.0001.exr", {24, 1});
  EXPECT_THAT(other_rates(shot, {1, 2}), IsEmpty());
  shot.fps = {24000, 1001};
  EXPECT_EQ(other_rates(shot, {1}).size(), 1U);
  write_frame(folder / "bg.0001.exr", {23976, 1000});
  EXPECT_THAT(other_rates(shot, {1}), IsEmpty()) << "written with fewer digits";
  folder.write("bg.0001.exr", "no picture");
  EXPECT_THAT(other_rates(shot, {1}), IsEmpty());
  EXPECT_EQ(read_frame_rate(folder / "bg.0002.exr")->numerator, 25);
}

}  // namespace
}  // namespace lensplane
