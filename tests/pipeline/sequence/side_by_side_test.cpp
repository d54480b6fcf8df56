// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/side_by_side.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <stdexcept>

namespace lensplane {
namespace {

TEST(SideBySide, RunsBoth) {
  int first = 0, second = 0;
  side_by_side([&] { first = 1; }, [&] { second = 2; });
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 2);
}

TEST(SideBySide, AFailureDoesNotCutTheOtherShort) {
  for (int n = 0; n < 20; ++n) {
    std::atomic<int> done = 0;
    const auto loop = [&] { tbb::parallel_for(0, 10000, [&](int) { ++done; }); };
    const auto failing = [] { throw std::runtime_error("no room"); };
    EXPECT_THROW(side_by_side(failing, loop), std::runtime_error);
    EXPECT_EQ(done, 10000);
    EXPECT_THROW(side_by_side(loop, failing), std::runtime_error);
    EXPECT_EQ(done, 20000);
  }
}

TEST(SideBySide, OfTwoFailuresTheFirstIsThrown) {
  const auto failing = [](const char* reason) { return [=] { throw std::runtime_error(reason); }; };
  try {
    side_by_side(failing("one"), failing("two"));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "one");
  }
}

}  // namespace
}  // namespace lensplane
