// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/shutter.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "src/constants.h"
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

/// The example's lens, which goes so many pixels in half a frame.
Shot shot_with_motion(double pixels, const std::string& shutter) {
  const double metres = 2 * pixels / (20 / std::tan(1.5 * kPi / 180)) * 4.36e8;
  return example_shot(
      {"camera.shutter=" + shutter,
       fmt::format("lenses.near.position={{keys: {{1001: [{0} m, 0 m, -4.36e8 m], 1003: [{1} m, 0 "
                   "m, -4.36e8 m]}}}}",
                   -metres, metres)});
}

TEST(Shutter, TakesAsManySamplesAsTheFastestMotionNeeds) {
  const struct {
    double pixels;
    int samples;
    bool strobes;
  } cases[] = {{0, 1, false},   {1.4, 1, false}, {1.6, 2, false}, {7.4, 5, false},
               {9.5, 7, false}, {95, 64, false}, {98, 64, true}};
  for (const auto& c : cases) {
    const Shot shot = shot_with_motion(c.pixels, "{open: -0.25, close: 0.25}");
    const ShutterSampling sampling = shutter_sampling(shot, 1002);
    EXPECT_EQ(sampling.samples, c.samples) << c.pixels;
    EXPECT_EQ(sampling.strobes(), c.strobes) << c.pixels;
    EXPECT_TRUE(sampling.automatic);
    EXPECT_NEAR(sampling.motion_px, c.pixels, 0.01 * c.pixels);
    EXPECT_EQ(moments_of(shot, 1002).size(), static_cast<std::size_t>(c.samples));
    EXPECT_EQ(worst_strobing(shot, {1001, 1002}).has_value(), c.strobes);
  }
}

TEST(Shutter, SaysWhatStrobes) {
  const Shot few = shot_with_motion(12.8, "{angle: 180 deg, samples: 4}");
  EXPECT_EQ(
      line_of(shutter_sampling(few, 1002)),
      "shutter: 4 samples, 3.2 px apart where the motion of frame 1002 is fastest: single moments are seen; "
      "samples: auto would do");
  ASSERT_TRUE(worst_strobing(few, {1002}));
  EXPECT_EQ(line_of(shutter_sampling(shot_with_motion(12.8, "{samples: auto}"), 1002)),
            "shutter: 9 samples, 1.4 px apart where the motion of frame 1002 is fastest (auto)");
  EXPECT_EQ(line_of(shutter_sampling(shot_with_motion(192.7, "{}"), 1002)),
            "shutter: 64 samples, 3 px apart where the motion of frame 1002 is fastest: auto takes 64 at "
            "most, and "
            "single moments are seen; 129 would be needed");
  EXPECT_EQ(line_of(shutter_sampling(example_shot({"camera.shutter={}"}), 1002)),
            "shutter: one sample; nothing moves by more than 1.5 px");
  // One sample is a still, and so is a shot without a shutter.
  EXPECT_FALSE(worst_strobing(shot_with_motion(12, "{samples: 1}"), {1002}));
  EXPECT_FALSE(worst_strobing(shot_with_motion(12, "null"), {1002}));
  EXPECT_EQ(moments_of(shot_with_motion(12, "null"), 1002).size(), 1U);
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
