// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/plate_margins.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "pipeline/shot/shot_reader.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 200, kHeight = 100;

/// A frame of a thousandth of a radian with a mass in its middle, whose Einstein ring is `ring` pixels wide;
/// `more` goes on in the camera.
Shot shot_with_ring(const TemporaryFolder& folder, double ring, const std::string& more = "") {
  constexpr double kFov = 1e-3;
  const double theta = ring * kFov / kWidth, m = theta * theta * 1e9 / 4;
  const auto file = folder.write(
      "margins.yaml", "lensplane: 1\nshot: margins\nframes: 1-3\ncamera: {resolution: [200, 100], fov: " +
                          std::to_string(kFov * 180 / M_PI) + " deg" + more +
                          "}\nlenses:\n  - {name: a, radius: " + std::to_string(2 * m) +
                          " m, position: [0 m, 0 m, -1e9 m]}\nlayers:\n  - {name: bg, type: plate, image: "
                          "none.exr}\n  - {name: sky, type: latlong, image: none.exr}\ntrace: {law: weak}\n");
  return read_shot(file.string(), {});
}

/// beta = theta (1 - ring^2/theta^2) for the middles of all pixels.
PlateMargin by_the_lens_equation(double ring) {
  PlateMargin margin;
  int outside = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const double x = column + 0.5 - kWidth / 2.0, y = row + 0.5 - kHeight / 2.0;
      const double share = 1 - ring * ring / (x * x + y * y);
      const double over = std::max(std::abs(x * share) - kWidth / 2.0, std::abs(y * share) - kHeight / 2.0);
      outside += over > 0;
      margin.all = std::max(margin.all, static_cast<int>(std::ceil(over)));
    }
  }
  margin.outside = static_cast<double>(outside) / (kWidth * kHeight);
  return margin;
}

TEST(PlateMargins, AreThoseOfTheLensEquation) {
  const TemporaryFolder folder;
  const Shot shot = shot_with_ring(folder, 12);
  const auto margins = plate_margins(shot, 1, kWidth * kHeight);
  ASSERT_EQ(margins.size(), 1);  // a sky has no outside
  const PlateMargin expected = by_the_lens_equation(12);
  EXPECT_EQ(margins[0].layer, "bg");
  EXPECT_NEAR(margins[0].outside, expected.outside, 1.5 / (kWidth * kHeight));
  EXPECT_GT(margins[0].outside, 0);
  EXPECT_NEAR(margins[0].all, expected.all, 0.002 * expected.all + 1);
  EXPECT_LE(margins[0].most, margins[0].all + 2);
  EXPECT_THAT(line_of(margins[0]), HasSubstr("layer bg: "));
}

TEST(PlateMargins, FewerPixelsSayNearlyTheSame) {
  const TemporaryFolder folder;
  const Shot shot = shot_with_ring(folder, 30);
  const PlateMargin all = plate_margins(shot, 1, kWidth * kHeight)[0],
                    few = plate_margins(shot, 1, kWidth * kHeight / 9)[0];
  EXPECT_NEAR(few.outside, all.outside, 0.01);
  EXPECT_GE(few.all, all.all / 4);
}

TEST(PlateMargins, WithoutLensesNothingIsOutside) {
  const TemporaryFolder folder;
  Shot shot = shot_with_ring(folder, 12, ", overscan: auto");
  shot.lenses.clear();
  EXPECT_EQ(plate_margins(shot, 1, 1000)[0].outside, 0);
  EXPECT_TRUE(worst_margins(shot, shot.frames).empty());
  EXPECT_EQ(with_overscan(shot).camera.overscan, 0);
}

TEST(PlateMargins, AutoOverscanIsEvenServesThePlatesAndIsNeverMoreThanTheFrame) {
  const TemporaryFolder folder;
  const Shot automatic = shot_with_ring(folder, 12, ", overscan: auto");
  ASSERT_FALSE(automatic.camera.overscan);
  const int overscan = *with_overscan(automatic).camera.overscan;
  EXPECT_EQ(overscan % 2, 0);
  EXPECT_GE(overscan, std::min(kWidth, plate_margins(automatic, 1, kWidth * kHeight)[0].most));
  EXPECT_LE(*with_overscan(shot_with_ring(folder, 60, ", overscan: auto")).camera.overscan, kWidth);
  EXPECT_EQ(*with_overscan(shot_with_ring(folder, 12, ", overscan: 8")).camera.overscan, 8);
}

}  // namespace
}  // namespace lensplane
