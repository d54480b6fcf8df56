// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/stopwatch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace lensplane {
namespace {

TEST(Stopwatch, TellsTheMedianAndTheSpread) {
  const Timing odd = timing_of({3, 1, 2});
  EXPECT_EQ(odd.median_s, 2);
  EXPECT_EQ(odd.least_s, 1);
  EXPECT_EQ(odd.most_s, 3);
  EXPECT_EQ(odd.repeats, 3);
  EXPECT_EQ(timing_of({4, 1, 2, 3}).median_s, 2.5);
}

TEST(Stopwatch, RepeatsUntilItHasSeenEnough) {
  int runs = 0;
  const auto brief = [&] { ++runs; };
  EXPECT_EQ(time_repeatedly({1.0, 2, 7, 1}, brief).repeats, 7);
  EXPECT_EQ(runs, 7);
  EXPECT_EQ(time_repeatedly({0.0, 3, 7, 1}, brief).repeats, 3);
  const auto long_enough = [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); };
  const Timing timing = time_repeatedly({0.03, 1, 7, 1}, long_enough);
  EXPECT_LE(timing.repeats, 2);
  EXPECT_GE(timing.least_s, 0.02);
  EXPECT_EQ(time_repeatedly({1, 3, 7, 1, 0.01}, long_enough).repeats, 1);
}

TEST(Stopwatch, ScalesAPartToTheWhole) {
  const Timing whole = scaled(timing_of({1, 2, 3}), 10);
  EXPECT_EQ(whole.median_s, 20);
  EXPECT_EQ(whole.most_s, 30);
  EXPECT_TRUE(whole.of_a_part);
  EXPECT_FALSE(scaled(timing_of({1}), 1).of_a_part);
}

TEST(Stopwatch, SeesMemoryThatIsGoneAgain) {
  constexpr std::size_t kBytes = std::size_t{48} << 20;
  const PeakMemory memory;
  if (!memory.bytes()) GTEST_SKIP() << "the system does not tell";
  const std::size_t before = *memory.bytes();
  { const std::vector<char> piece(kBytes, 1); }
  EXPECT_GT(*memory.bytes(), before + kBytes * 9 / 10);
  EXPECT_LT(*memory.bytes(), before + kBytes * 2);
  EXPECT_LT(*PeakMemory().bytes(), kBytes / 2);  // and only since it was made
}

}  // namespace
}  // namespace lensplane
