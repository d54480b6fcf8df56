// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/frame_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lensplane {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(FrameRange, ReadsEveryForm) {
  EXPECT_THAT(parse_frames("1001").frames, ElementsAre(1001));
  EXPECT_THAT(parse_frames("1001-1004").frames, ElementsAre(1001, 1002, 1003, 1004));
  EXPECT_THAT(parse_frames("1001-1010x4").frames, ElementsAre(1001, 1005, 1009));
  EXPECT_THAT(parse_frames("1001,1005,1010-1012").frames, ElementsAre(1001, 1005, 1010, 1011, 1012));
  EXPECT_THAT(parse_frames(" 1 - 3 , 7 ").frames, ElementsAre(1, 2, 3, 7));
  EXPECT_THAT(parse_frames("5,1-3,2").frames, ElementsAre(1, 2, 3, 5));
  EXPECT_THAT(parse_frames("0").frames, ElementsAre(0));
}

TEST(FrameRange, SaysWhatIsWrong) {
  EXPECT_EQ(parse_frames("1048-1001").error, "\"1048-1001\" ends before it starts; write 1001-1048");
  EXPECT_THAT(parse_frames("1-9x0").error, HasSubstr("steps by 0"));
  for (const char* text :
       {"", ",", "1,", "a", "1-", "-3", "1-3x", "1-3y2", "1.5", "1 2 x", "99999999999", "0x10"}) {
    EXPECT_NE(parse_frames(text).error, "") << text;
  }
  EXPECT_THAT(parse_frames("1-9999999").error, HasSubstr("more than 1000000 frames"));
}

}  // namespace
}  // namespace lensplane
