// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>

#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::ElementsAre;

struct Outcome {
  ProcessEnd end;
  std::vector<std::string> lines;
};

Outcome run(
    const std::vector<std::string>& words, const std::function<Watch()>& watch = [] { return Watch::GoOn; }) {
  const TemporaryFolder folder;
  Outcome result;
  result.end = run_process(
      {words, folder.path()}, [&](const std::string& line) { result.lines.push_back(line); }, watch);
  return result;
}

TEST(Process, HandsOnWhatIsSaid) {
  const Outcome a = run({"sh", "-c", "printf 'one\\ntwo\\rthree' >&2; echo lost; exit 3"});
  EXPECT_TRUE(a.end.started);
  EXPECT_EQ(a.end.exit_code, 3);
  EXPECT_EQ(a.end.signal, 0);
  EXPECT_THAT(a.lines, ElementsAre("one", "two", "three"));
}

TEST(Process, IsNotStartedWhereThereIsNone) {
  EXPECT_FALSE(run({"no-such-program-anywhere"}).end.started);
}

TEST(Process, SaysWhichSignalEndedIt) {
  const Outcome a = run({"sh", "-c", "kill -SEGV $$"});
  EXPECT_EQ(a.end.signal, SIGSEGV);
  EXPECT_EQ(a.end.exit_code, -1);
  EXPECT_FALSE(a.end.killed);
}

TEST(Process, IsKilledWithAllThatItHasStarted) {
  const auto start = std::chrono::steady_clock::now();
  const auto after_a_moment = [&] {
    return std::chrono::steady_clock::now() - start > std::chrono::milliseconds(300) ? Watch::Kill
                                                                                     : Watch::GoOn;
  };
  const Outcome a = run({"sh", "-c", "sleep 60 & sleep 60"}, after_a_moment);
  EXPECT_TRUE(a.end.killed);
  EXPECT_EQ(a.end.signal, SIGKILL);
  // It may close what it says and go on.
  EXPECT_TRUE(run({"sh", "-c", "exec 2>&-; sleep 60"}, after_a_moment).end.killed);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Process, RunsInItsFolder) {
  const TemporaryFolder folder;
  run_process(
      {{"sh", "-c", "echo x > here"}, folder.path()}, [](const std::string&) {}, [] { return Watch::GoOn; });
  EXPECT_TRUE(std::filesystem::exists(folder / "here"));
}

}  // namespace
}  // namespace lensplane
