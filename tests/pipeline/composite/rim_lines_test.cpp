// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/rim_lines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/composite/footprint.h"
#include "pipeline/composite/normal_distribution.h"

namespace lensplane {
namespace {

// Sums of a hundred doubles.
constexpr double kRounding = 1e-12;

RimLine crossing(double rim, double phase, bool turned = false) {
  const double side = turned ? -1 : 1;
  return {0, 0.2, phase, rim - side * kRimWidth / 2, rim + side * kRimWidth / 2, true};
}

/// The weight of rays within `reach` of the rim, on the side of the light.
double light_within(double reach, const RimLine& line) {
  std::vector<RimRay> rays;
  add_rays(line, rays);
  double sum = 0;
  for (const RimRay& ray : rays) {
    const double off = (ray.along - line.free) * (line.free > line.captured ? 1 : -1);
    if (off > 0 && off < reach) sum += ray.weight;
  }
  return sum;
}

TEST(RimLines, WeightsAddUpToOne) {
  for (const double rim : {-1.39, -0.7, 0.0, 0.3, 1.2, 1.3999}) {
    for (const bool turned : {false, true}) {
      std::vector<RimRay> rays;
      add_rays(crossing(rim, 0.4, turned), rays);
      double sum = 0;
      for (const RimRay& ray : rays) {
        sum += ray.weight;
        EXPECT_GE(ray.weight, 0);
        EXPECT_LE(std::abs(ray.along), kLineReach);
        EXPECT_EQ(ray.aside, 0.2);
      }
      EXPECT_NEAR(sum, 1, kRounding) << rim;
    }
  }
  std::vector<RimRay> rays;
  add_rays({0, 0, 0}, rays);
  double sum = 0;
  for (const RimRay& ray : rays) sum += ray.weight;
  EXPECT_NEAR(sum, 1, kRounding);
}

TEST(RimLines, CapturedAndFreeLightHaveWhatTheFilterHasOfThem) {
  for (const double rim : {-0.7, 0.0, 0.3}) {
    EXPECT_NEAR(light_within(10, crossing(rim, 0)), normal_share(-rim / kPixelSigma), 1e-4);
    EXPECT_NEAR(light_within(10, crossing(rim, 0, true)), normal_share(rim / kPixelSigma), 1e-4);
  }
}

TEST(RimLines, PhasesTogetherAreRightForImagesOfAnyWidth) {
  constexpr int kPhases = 64;
  for (const double width : {3e-4, 0.0123, 0.1, 0.16}) {
    double mean = 0, worst = 0;
    const double rim = 0.1;
    const double truth = normal_share((rim + width) / kPixelSigma) - normal_share(rim / kPixelSigma);
    for (int n = 0; n < kPhases; ++n) {
      const double light = light_within(width, crossing(rim, (n + 0.5) / kPhases));
      mean += light / kPhases;
      worst = std::max(worst, std::abs(light / truth - 1));
    }
    EXPECT_NEAR(mean / truth, 1, 0.01) << width;
    EXPECT_LT(worst, 0.3) << width;  // of one line; a pixel has four
  }
}

TEST(RimLines, OfAPixelAreAsWideAsItsFilter) {
  for (const int rays : {4, 16, 64}) {
    const std::vector<RimLine> lines = lines_across(7, {3.5, 4.5}, {.max = rays});
    ASSERT_EQ(static_cast<int>(lines.size()), rim_lines_of(rays));
    double variance = 0;
    for (const RimLine& line : lines) {
      variance += line.aside * line.aside / static_cast<double>(lines.size());
      EXPECT_EQ(line.pixel, 7U);
    }
    const double width = rim_line_width(rim_lines_of(rays));
    EXPECT_NEAR(variance / (kPixelSigma * kPixelSigma) + width * width, 1, kRounding);
  }
}

}  // namespace
}  // namespace lensplane
