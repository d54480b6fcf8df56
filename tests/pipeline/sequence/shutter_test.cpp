// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/shutter.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/pipeline/shot/example_shot.h"

namespace lensplane {
namespace {

constexpr double kTimeError = 1e-12;  // frames

std::vector<Moment> moments_with(const std::string& shutter, const std::string& sampling, int frame = 1001) {
  return moments_of(example_shot({"camera.shutter=" + shutter, "sampling=" + sampling}), frame);
}

TEST(Shutter, OneSampleIsTheFrameItselfWheneverTheShutterOpens) {
  const auto moments = moments_with("{open: 0.25, close: 0.75, samples: 1}", "{max: 16, threshold: 0.01}");
  ASSERT_EQ(moments.size(), 1U);
  EXPECT_EQ(moments[0].time, 1001);
  EXPECT_EQ(moments[0].sampling.max, 16);
  EXPECT_EQ(moments[0].sampling.threshold, 0.01);
  EXPECT_EQ(moments[0].sampling.first, 0);
  // And it is what a shot without a shutter takes.
  const auto without = moments_of(example_shot(), 1001);
  ASSERT_EQ(without.size(), 1U);
  EXPECT_EQ(without[0].time, 1001);
}

TEST(Shutter, MomentsAreTheMiddlesOfEqualParts) {
  // From 1000.75 to 1001.5 in thirds of 0.25.
  const auto three = moments_with("{open: -0.25, close: 0.5, samples: 3}", "{max: 64}");
  ASSERT_EQ(three.size(), 3U);
  EXPECT_NEAR(three[0].time, 1000.875, kTimeError);
  EXPECT_NEAR(three[1].time, 1001.125, kTimeError);
  EXPECT_NEAR(three[2].time, 1001.375, kTimeError);
  const auto two = moments_with("{open: 0, close: 1, samples: 2}", "{max: 64}", 7);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_NEAR(two[0].time, 7.25, kTimeError);
  EXPECT_NEAR(two[1].time, 7.75, kTimeError);
}

TEST(Shutter, OpensAndClosesAsItsKeysSayAtTheFrame) {
  const std::string keyed =
      "{open: {keys: {1001: 0, 1003: -0.5}}, close: {keys: {1001: 1, 1003: 0.5}}, samples: 2}";
  EXPECT_NEAR(moments_with(keyed, "{max: 64}", 1001)[0].time, 1001.25, kTimeError);
  EXPECT_NEAR(moments_with(keyed, "{max: 64}", 1002)[0].time, 1002, kTimeError);
  EXPECT_NEAR(moments_with(keyed, "{max: 64}", 1003)[1].time, 1003.25, kTimeError);
}

TEST(Shutter, MomentsShareTheRaysOfAPixel) {
  // A quarter as many rays as long as all moments together have as many as one would; at least four.
  const struct {
    int max, samples, each;
  } cases[] = {{64, 2, 64}, {64, 3, 64}, {64, 4, 16}, {64, 15, 16}, {64, 16, 4}, {64, 256, 4},
               {16, 3, 16}, {16, 4, 4},  {4, 4, 4},   {4, 256, 4},  {1, 8, 1}};
  for (const auto& c : cases) {
    const auto moments = moments_with("{open: 0, close: 0.5, samples: " + std::to_string(c.samples) + "}",
                                      "{max: " + std::to_string(c.max) + ", threshold: 0.02}");
    ASSERT_EQ(static_cast<int>(moments.size()), c.samples);
    std::set<int> points;
    for (const Moment& moment : moments) {
      EXPECT_EQ(moment.sampling.max, c.each) << c.max << " " << c.samples;
      EXPECT_EQ(moment.sampling.threshold, 0.02);
      EXPECT_EQ(moment.sampling.first % c.each, 0);
      ASSERT_LE(moment.sampling.first + c.each, kMostSamples);
      for (int i = 0; i < c.each; ++i) points.insert(moment.sampling.first + i);
    }
    // They begin at points of their own as long as there are some.
    EXPECT_EQ(static_cast<int>(points.size()), std::min(kMostSamples, c.samples * c.each))
        << c.max << " " << c.samples;
  }
}

}  // namespace
}  // namespace lensplane
