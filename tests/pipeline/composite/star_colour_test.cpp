// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_colour.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lensplane {
namespace {

TEST(StarColour, TemperatureIsThatOfBallesteros) {
  EXPECT_NEAR(temperature_from_b_minus_v(0.65), 5778, 30);  // the sun
  EXPECT_NEAR(temperature_from_b_minus_v(0.0), 10125, 1);
  EXPECT_GT(temperature_from_b_minus_v(-0.4), 20000);
  EXPECT_LT(temperature_from_b_minus_v(2.0), 3200);
}

TEST(StarColour, BlackbodiesLieOnThePlanckianLocus) {
  const struct {
    double kelvin, x, y;  // CIE 1931
  } locus[] = {{2000, 0.5267, 0.4133},
               {2856, 0.4476, 0.4074},
               {4000, 0.3805, 0.3768},
               {6500, 0.3135, 0.3237},
               {10000, 0.2807, 0.2884}};
  for (const auto& point : locus) {
    const Chromaticity c = blackbody_chromaticity(point.kelvin);
    EXPECT_NEAR(c.x, point.x, 0.003) << point.kelvin;
    EXPECT_NEAR(c.y, point.y, 0.003) << point.kelvin;
  }
}

TEST(StarColour, AcescgIsThatOfColourManagement) {
  // White is neutral; red of Rec.709 as in OpenColorIO, (.6131, .07019, .02062) of luminance .2138.
  for (const double channel : acescg_from_chromaticity({0.3127, 0.3290})) EXPECT_NEAR(channel, 1, 1e-6);
  const Rgb red = acescg_from_chromaticity({0.64, 0.33});
  EXPECT_NEAR(red[1] / red[0], 0.07019 / 0.6131, 1e-4);
  EXPECT_NEAR(red[2] / red[0], 0.02062 / 0.6131, 1e-4);
}

TEST(StarColour, HasLuminanceOneAndGoesFromBlueToRed) {
  double before = 0;
  for (double b_minus_v = -0.6; b_minus_v <= 10; b_minus_v += 0.1) {
    const Rgb c = star_colour(b_minus_v);
    EXPECT_NEAR(0.2722287 * c[0] + 0.6740818 * c[1] + 0.0536895 * c[2], 1, 1e-6) << b_minus_v;
    for (const double channel : c) EXPECT_GE(channel, 0) << b_minus_v;
    const double redness = c[0] / (c[1] + c[2]);
    EXPECT_GT(redness, before) << b_minus_v;
    before = redness;
  }
  const Rgb sun_like = star_colour(0.5);
  EXPECT_NEAR(sun_like[0], sun_like[2], 0.1);
}

}  // namespace
}  // namespace lensplane
