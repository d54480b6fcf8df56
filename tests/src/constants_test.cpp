// SPDX-License-Identifier: Apache-2.0

#include "src/constants.h"

#include <gtest/gtest.h>

namespace lensplane {
namespace {

TEST(Constants, SeedMassHasTheGeometricMassOfItsPublishedFigure) {
  EXPECT_NEAR(geometric_mass_from_kg(1.989e31) / 14770.63277528, 1.0, 1e-12);
}

TEST(Constants, LightBendsByItsPublishedAngleAtTheSunsLimb) {
  const double arcsec = 3600.0 * 180.0 / kPi;
  EXPECT_NEAR(4.0 * geometric_mass_from_gm(kSunGM) / kSunRadius * arcsec, 1.75119032556, 1e-10);
}

TEST(Constants, ParsecAndLightYearAgreeWithTheirPublishedRatio) {
  EXPECT_NEAR(kParsec / kLightYear, 3.261563777167433, 1e-12);
}

}  // namespace
}  // namespace lensplane
