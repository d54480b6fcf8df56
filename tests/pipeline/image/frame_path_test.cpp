// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/frame_path.h"

#include <gtest/gtest.h>

namespace lensplane {
namespace {

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

}  // namespace
}  // namespace lensplane
