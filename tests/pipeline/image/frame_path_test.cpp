// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/frame_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(FramePath, FillsTheFrameNumberIn) {
  EXPECT_EQ(path_of_frame("plates/bg.####.exr", 7), "plates/bg.0007.exr");
  EXPECT_EQ(path_of_frame("plates/bg.####.exr", 123456), "plates/bg.123456.exr");
  EXPECT_EQ(path_of_frame("bg.#.exr", 1001), "bg.1001.exr");
  EXPECT_EQ(path_of_frame("bg.%04d.exr", 7), "bg.0007.exr");
  EXPECT_EQ(path_of_frame("bg%d.exr", 7), "bg7.exr");
  EXPECT_EQ(path_of_frame("a##/bg.###.exr", 7), "a##/bg.007.exr");
  EXPECT_EQ(path_of_frame("bg.exr", 7), "bg.exr");
  EXPECT_EQ(path_of_frame("take#1/%d/bg.exr", 7), "take#1/%d/bg.exr");
  EXPECT_EQ(path_of_frame("take#1/bg.%04d.exr", 7), "take#1/bg.0007.exr");
}

TEST(FramePath, KnowsSequences) {
  EXPECT_TRUE(is_sequence("bg.####.exr"));
  EXPECT_TRUE(is_sequence("bg.%04d.exr"));
  EXPECT_FALSE(is_sequence("bg.1001.exr"));
  EXPECT_FALSE(is_sequence("100%.exr"));
}

TEST(FramePath, FindsTheFramesThatThereAre) {
  const TemporaryFolder folder;
  for (const char* name :
       {"bg.0010.exr", "bg.0009.exr", "bg.10000.exr", "bg.-001.exr", "bg.9.exr", "bg.0011.png",
        "bg.0012.exr.part", "bg..exr", "b", "fg.0013.exr", "bg.99999999999.exr"})
    folder.write(name, "");
  EXPECT_THAT(frames_on_disk((folder / "bg.####.exr").string()), ElementsAre(-1, 9, 10, 10000));
  EXPECT_THAT(frames_on_disk((folder / "bg.%04d.exr").string()), ElementsAre(-1, 9, 10, 10000));
  EXPECT_THAT(frames_on_disk((folder / "bg.#.exr").string()), ElementsAre(9, 10000));
  EXPECT_THAT(frames_on_disk((folder / "####").string()), IsEmpty());
  EXPECT_THAT(frames_on_disk((folder / "none/bg.####.exr").string()), IsEmpty());
  EXPECT_THAT(frames_on_disk((folder / "bg.0010.exr").string()), IsEmpty());
}

}  // namespace
}  // namespace lensplane
