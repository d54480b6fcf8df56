// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/chan_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::StartsWith;

TEST(ChanFile, ReadsWhatOtherProgramsWrite) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.chan",
                                 "# a comment\n"
                                 "1001\t1.5\t-2\t3e2\t10\t20\t-30\t45.5\r\n"
                                 "\n"
                                 "  1002 +1.5 -2 300.0 1e1 20 -30 45   # the end\n");
  const std::vector<ChanKey> keys = read_chan(path);
  ASSERT_EQ(keys.size(), 2);
  EXPECT_EQ(keys[0].frame, 1001);
  EXPECT_EQ(keys[0].position, Vec3(1.5, -2, 300));
  EXPECT_EQ(keys[0].rotation_deg, Vec3(10, 20, -30));
  EXPECT_EQ(keys[0].vertical_fov_deg, 45.5);
  EXPECT_EQ(keys[1].position, keys[0].position);
  EXPECT_EQ(keys[1].vertical_fov_deg, 45);
  const auto without = read_chan(folder.write("b.chan", "1 0 0 0 0 0 0"));
  EXPECT_FALSE(without[0].vertical_fov_deg);
}

TEST(ChanFile, TextKeepsAllDigits) {
  const TemporaryFolder folder;
  const std::vector<ChanKey> keys = {{1, {1.0 / 3, 1e-300, -1e25}, {0.1, 123.456, -359.9}, {}},
                                     {2.5, {0, 0, 0}, {1, 2, 3}, {}}};
  const std::vector<ChanKey> back = read_chan(folder.write("a.chan", chan_text(keys)));
  ASSERT_EQ(back.size(), 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].frame, keys[i].frame);
    EXPECT_EQ(back[i].position, keys[i].position);
    EXPECT_EQ(back[i].rotation_deg, keys[i].rotation_deg);
  }
  EXPECT_EQ(chan_text({{7, {1, 2, 3}, {4, 5, 6}, 30.0}}), "7 1 2 3 4 5 6 30\n");
}

TEST(ChanFile, RefusesWithTheLine) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& text, const std::string& what) {
    const auto path = folder.write("a.chan", text);
    const Refusal refusal = refusal_of([&] { read_chan(path); });
    EXPECT_EQ(refusal.code, ExitCode::BadInput) << text;
    EXPECT_THAT(refusal.line, StartsWith(path.string() + what)) << text;
  };
  expect("1 0 0 0 0 0 0 40\n2 0 0 zero 0 0 0 40\n", ":2: \"zero\" is no number; needed: frame tx ty tz");
  expect("1 0 0 0 0 0 0 40,5\n", ":1: \"40,5\" is no number");
  expect("1 0 0 0 0 0 nan\n", ":1: \"nan\" is no number");
  expect("1 0 0 1e400 0 0 0\n", ":1: \"1e400\" is no number");
  expect("1 0 0 0 0 0\n", ":1: 6 numbers; needed");
  expect("1 0 0 0 0 0 0 40 50\n", ":1: 9 numbers; needed");
  expect("\n1 0 0 0 0 0 0 180\n", ":2: a field of view of 180 deg; allowed: more than 0 and less than 180");
  expect("1 0 0 0 0 0 0 0\n", ":1: a field of view of 0 deg");
  expect("2 0 0 0 0 0 0\n2 0 0 0 0 0 0\n", ":2: frame 2 comes after frame 2; needed: ascending frames");
  expect("1 0 0 0 0 0 0 40\n2 0 0 0 0 0 0\n", ":2: some lines have a field of view and others have none");
  expect("# nothing\n\n", ": it has no frames; needed");
  expect(std::string("\x76\x2f\x31\x01\x02\x00\x00", 7), ":1: ");
  EXPECT_EQ(refusal_of([&] { read_chan(folder.path()); }).line,
            folder.path().string() + ": no such camera file");
}

}  // namespace
}  // namespace lensplane
