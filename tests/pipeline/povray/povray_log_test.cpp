// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/povray_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lensplane {
namespace {

using testing::ElementsAre;

TEST(PovRayLog, KeepsWhatIsWrong) {
  PovRayLog log;
  const auto now = PovRayLog::Clock::now();
  for (const char* line :
       {"Persistence of Vision(tm)", "  Warning Stream to console.......On",
        "File 'a.pov' line 3: Parse Warning: something", "File 'a.pov' line 5: Possible Parse Error: x",
        "File 'a.pov' line 7: Parse Error: Missing } in the", " middle of a long line",
        "Fatal error in parser: Cannot parse input.", "Render failed"})
    log.add(line, now);
  EXPECT_EQ(log.complaint(), "File 'a.pov' line 7: Parse Error: Missing } in the middle of a long line");
  EXPECT_THAT(log.warnings(), ElementsAre("File 'a.pov' line 3: Parse Warning: something"));
}

TEST(PovRayLog, GetsOnWithPixelsAndNewWords) {
  PovRayLog log;
  const auto start = PovRayLog::Clock::now();
  const auto at = [&](int seconds) { return start + std::chrono::seconds(seconds); };
  log.add("Parsing 1s", at(1));
  EXPECT_EQ(log.last_progress(), at(1));
  log.add("Parsing 2s", at(2));
  EXPECT_EQ(log.last_progress(), at(1)) << "counting seconds is no progress";
  log.add("Rendered 0 of 100 pixels (0%)", at(3));
  EXPECT_EQ(log.last_progress(), at(3));
  log.add("Rendered 0 of 100 pixels (0%)", at(4));
  EXPECT_EQ(log.last_progress(), at(3));
  log.add("Rendered 10 of 100 pixels (10%)", at(5));
  EXPECT_EQ(log.last_progress(), at(5));
  log.add("something else", at(6));
  EXPECT_EQ(log.last_progress(), at(6));
  EXPECT_EQ(log.last_lines(), "Parsing 1s Parsing 2s something else");
  EXPECT_EQ(log.complaint(), log.last_lines());
}

}  // namespace
}  // namespace lensplane
