// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/map_reader.h"

#include <OpenImageIO/imagebuf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Pixels = std::vector<std::vector<float>>;

/// One row, a list of channels for each pixel.
void write_row(const std::filesystem::path& path, const std::vector<std::string>& channels,
               const Pixels& pixels, OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT) {
  OIIO::ImageSpec spec(static_cast<int>(pixels.size()), 1, static_cast<int>(channels.size()), type);
  spec.channelnames = channels;
  OIIO::ImageBuf image(spec);
  for (std::size_t i = 0; i < pixels.size(); ++i) image.setpixel(static_cast<int>(i), 0, pixels[i].data());
  ASSERT_TRUE(image.write(path.string()));
}

TEST(MapReader, CoverageIsBElseAElseFull) {
  const TemporaryFolder folder;
  write_row(folder / "b.exr", {"R", "G", "B", "A"}, {{.1F, .2F, .5F, 1}, {.3F, .4F, 2, 1}});
  const StMap map = read_st_map(folder / "b.exr");
  EXPECT_THAT(map.s, ElementsAre(.1F, .3F));
  EXPECT_THAT(map.t, ElementsAre(.2F, .4F));
  EXPECT_THAT(map.coverage, ElementsAre(.5F, 1.F));
  EXPECT_FALSE(map.half);
  write_row(folder / "a.exr", {"R", "G", "A"}, {{.1F, .2F, .25F}});
  EXPECT_THAT(read_st_map(folder / "a.exr").coverage, ElementsAre(.25F));
  write_row(folder / "rg.exr", {"R", "G"}, {{.1F, .2F}});
  EXPECT_THAT(read_st_map(folder / "rg.exr").coverage, ElementsAre(1.F));
}

TEST(MapReader, BlackBlueMeansNothingUnlessAllIsBlack) {
  const TemporaryFolder folder;
  write_row(folder / "rgb.exr", {"R", "G", "B"}, {{.1F, .2F, 0}});
  EXPECT_THAT(read_st_map(folder / "rgb.exr").coverage, ElementsAre(1.F));
  write_row(folder / "black.exr", {"R", "G", "B"}, {{0, 0, 0}});
  EXPECT_THAT(read_st_map(folder / "black.exr").coverage, ElementsAre(0.F));
}

TEST(MapReader, TheOriginIsWhereTheCallerOrTheFileSays) {
  const TemporaryFolder folder;
  write_row(folder / "m.exr", {"R", "G"}, {{.1F, .25F}});
  EXPECT_EQ(read_st_map(folder / "m.exr").t[0], .25F);
  EXPECT_EQ(read_st_map(folder / "m.exr", StOrigin::TopLeft).t[0], .75F);
  OIIO::ImageBuf image((folder / "m.exr").string());
  image.specmod()["lensplane:st_origin"] = "top left";
  image.write((folder / "top.exr").string());
  EXPECT_EQ(read_st_map(folder / "top.exr").t[0], .75F);
  EXPECT_EQ(read_st_map(folder / "top.exr", StOrigin::BottomLeft).t[0], .25F);
}

TEST(MapReader, WhatIsNoNumberIsNotCovered) {
  const TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  write_row(folder / "m.exr", {"R", "G", "B"},
            {{nan, .2F, 1}, {.1F, inf, 1}, {.1F, .2F, nan}, {.1F, .2F, 1}});
  const StMap map = read_st_map(folder / "m.exr");
  EXPECT_THAT(map.coverage, ElementsAre(0.F, 0.F, 0.F, 1.F));
  EXPECT_THAT(map.s, ElementsAre(0.F, 0.F, 0.F, .1F));
}

TEST(MapReader, WindowsAndHalfAreKept) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(6, 4, 2, OIIO::TypeDesc::HALF);
  spec.channelnames = {"R", "G"};
  spec.x = spec.y = -1;
  spec.full_width = 4;
  spec.full_height = 2;
  OIIO::ImageBuf(spec).write((folder / "m.exr").string());
  const StMap map = read_st_map(folder / "m.exr");
  EXPECT_TRUE(map.half);
  EXPECT_THAT((std::array{map.width, map.height, map.x, map.y, map.display_width, map.display_height}),
              ElementsAre(6, 4, -1, -1, 4, 2));
}

TEST(MapReader, WhatIsNoMapIsRefusedByName) {
  const TemporaryFolder folder;
  const auto line = [&](const std::string& name) {
    const Refusal refusal = refusal_of([&] { read_st_map(folder / name); });
    EXPECT_EQ(refusal.code, ExitCode::BadInput);
    return refusal.line;
  };
  EXPECT_EQ(line("none.exr"), (folder / "none.exr").string() + ": no such map");
  write_row(folder / "y.exr", {"Y"}, {{1}});
  EXPECT_THAT(line("y.exr"), HasSubstr("y.exr: cannot be read as a map: it has no channel R; needed: R = s"));
  write_row(folder / "i.tif", {"R", "G", "B"}, {{0, 0, 0}}, OIIO::TypeDesc::UINT16);
  EXPECT_THAT(line("i.tif"), HasSubstr("its channel R has whole numbers (uint16); needed: float"));
  write_row(folder / "cut.exr", {"R", "G"}, Pixels(5000, {.1F, .2F}));
  std::filesystem::resize_file(folder / "cut.exr", std::filesystem::file_size(folder / "cut.exr") / 2);
  EXPECT_THAT(line("cut.exr"), HasSubstr("cut.exr: cannot be read as a map: "));
}

TEST(MapReader, DataFilesGiveWhatTheyHave) {
  const TemporaryFolder folder;
  write_row(folder / "x.bg.map.0001.exr", {"R", "G"}, {{.1F, .2F}});
  const StMap map = read_st_map(folder / "x.bg.map.0001.exr");
  EXPECT_EQ(data_file_beside(folder / "x.bg.map.0001.exr"), std::nullopt);
  EXPECT_EQ(data_file_beside(folder / "warp.exr"), std::nullopt);
  const auto beside = folder / "x.bg.data.0001.exr";
  write_row(beside, {"jacobian.ds_dx", "jacobian.ds_dy", "jacobian.dt_dx", "jacobian.dt_dy"}, {{1, 2, 3, 4}});
  EXPECT_EQ(data_file_beside(folder / "x.bg.map.0001.exr"), beside);
  const MapData data = read_map_data(beside, map);
  ASSERT_TRUE(data.jacobian);
  EXPECT_THAT(data.jacobian->dt_dx, ElementsAre(3.F));
  EXPECT_TRUE(data.depth.empty());
  write_row(beside, {"depth.z"}, {{5}});
  EXPECT_FALSE(read_map_data(beside, map).jacobian);
  EXPECT_THAT(read_map_data(beside, map).depth, ElementsAre(5.F));
  write_row(beside, {"depth.z"}, {{5}, {6}});
  EXPECT_THAT(refusal_of([&] { read_map_data(beside, map); }).line,
              HasSubstr("2 x 1 pixels from (0, 0), its map 1 x 1 from (0, 0)"));
}

}  // namespace
}  // namespace lensplane
