// SPDX-License-Identifier: Apache-2.0

#include "src/disc.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "src/finite_shift.h"
#include "tests/src/deflector_scenes.h"

namespace lensplane {
namespace {

TEST(Disc, NoCrossingLiesBeyondItsStretch) {
  // Stretches before, between and behind masses, near enough for the light to run far beside them.
  std::mt19937 random(3);
  const auto from = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto vector = [&](double size) {
    return Vec3(from(-size, size), from(-size, size), from(-size, size));
  };
  int crossings = 0;
  for (int n = 0; n < 20000; ++n) {
    const Deflectors masses = flat_deflectors(
        {{1, vector(5) - Vec3(0, 0, 30)}, {0.5, vector(5) - Vec3(0, 0, 60)}}, Law::Exact, true);
    const Ring ring{vector(8) - Vec3(0, 0, from(20, 70)), basis_from_zxy(vector(3)), 0, 20};
    const Disc disc = *disc_of(ring);
    const int bends = n % 3;
    RaySegment<double> stretch{vector(6) - Vec3(0, 0, 30.0 * bends),
                               (vector(0.2) - Vec3(0, 0, 1)).normalized()};
    stretch.length = bends == 2 ? std::numeric_limits<double>::infinity() : from(1, 40);
    stretch.bends = bends;
    const auto light_at = [&](double way) {
      return stretch.start + stretch.direction * way + finite_shift(masses, stretch, way);
    };
    DiscPassage passage{side_at(disc, height_over(disc, light_at(0)))};
    const auto crossing = meet_disc(disc, stretch, &masses, passage);
    if (!crossing) continue;
    ++crossings;
    EXPECT_GE(crossing->way, 0.0);
    EXPECT_LE(crossing->way, stretch.length);
    EXPECT_LT((crossing->point - light_at(crossing->way)).length(), 1e-5) << n;
    EXPECT_LE(std::abs(height_over(disc, crossing->point)), disc.tolerance) << n;
  }
  EXPECT_GT(crossings, 1000);
}

}  // namespace
}  // namespace lensplane
