// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/sun_disc.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/basis.h"
#include "src/constants.h"

namespace lensplane {
namespace {

// Of sums over 1000 x 1000 places of the disc.
constexpr double kSumError = 2e-3;

/// The mean over a sun around +z of `seen(direction)`, by places of equal solid angle.
template <class Seen>
double mean_over_sun(double sun, Seen seen) {
  constexpr int kPlaces = 1000;
  double sum = 0;
  for (int ring = 0; ring < kPlaces; ++ring) {
    const double share = (ring + 0.5) / kPlaces, half = std::sqrt(share) * std::sin(sun / 2);
    const double off = 2 * std::asin(half);
    for (int part = 0; part < kPlaces; ++part) {
      const double round = 2 * kPi * (part + 0.5) / kPlaces;
      sum += seen(Vec3(std::sin(off) * std::cos(round), std::sin(off) * std::sin(round), std::cos(off)));
    }
  }
  return sum / (kPlaces * kPlaces);
}

TEST(SunDisc, BallsLeaveTheShareThatPlacesOfTheSunSee) {
  struct Case {
    double sun, ball;
  };
  for (const Case c : {Case{0.0046, 0.7}, Case{0.0046, 0.005}, Case{0.0046, 0.002}, Case{0.3, 0.5}}) {
    for (const double part : {-1.5, -0.99, -0.5, 0.0, 0.3, 0.9, 0.999, 1.5}) {
      const double apart = c.ball + part * c.sun;
      if (apart < 0) continue;
      const Vec3 middle(std::sin(apart), 0, std::cos(apart));
      const double truth = mean_over_sun(
          c.sun, [&](const Vec3& d) { return (d - middle).length() > 2 * std::sin(c.ball / 2) ? 1.0 : 0.0; });
      EXPECT_NEAR(free_share(c.sun, c.ball, apart), truth, kSumError)
          << c.sun << " " << c.ball << " " << part;
    }
  }
}

TEST(SunDisc, HasUmbraPenumbraAndAntumbra) {
  EXPECT_EQ(free_share(0.01, 0.02, 0.0099), 0);
  EXPECT_GT(free_share(0.01, 0.02, 0.0105), 0);
  EXPECT_LT(free_share(0.01, 0.02, 0.0295), 1);
  EXPECT_EQ(free_share(0.01, 0.02, 0.0301), 1);
  EXPECT_NEAR(free_share(0.01, 0.005, 0), 0.75, 1e-4);
  EXPECT_NEAR(free_share(0.01, 0.005, 0.0049), 0.75, 1e-4);
  EXPECT_EQ(free_share(0, 0.02, 0.0199), 0);  // a point
  EXPECT_EQ(free_share(0, 0.02, 0.0201), 1);
  EXPECT_EQ(free_share(0.01, 0, 0), 1);  // no ball
}

TEST(SunDisc, LambertsLawOverADiscThatTheHorizonCuts) {
  for (const double sun : {0.0046, 0.1, 0.5}) {
    for (const double part : {-1.1, -0.95, -0.5, -0.1, 0.0, 0.1, 0.5, 0.95, 1.1, 2.0}) {
      const double height = part * sun;
      const Vec3 zenith(std::cos(height), 0, std::sin(height));
      const double truth = mean_over_sun(sun, [&](const Vec3& d) { return std::max(0.0, d.dot(zenith)); });
      EXPECT_NEAR(lambert_share(sun, std::sin(height)), truth, kSumError * sun) << sun << " " << part;
    }
  }
  EXPECT_EQ(lambert_share(0, 0.3), 0.3);
  EXPECT_EQ(lambert_share(0, -0.3), 0);
  EXPECT_NEAR(lambert_share(0.0046, 1), 1, 1e-5);
}

}  // namespace
}  // namespace lensplane
