// SPDX-License-Identifier: Apache-2.0

#include "src/schwarzschild_sky.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/src/schwarzschild.h"

namespace lensplane {
namespace {

constexpr double kDegree = kPi / 180;

TEST(SchwarzschildSky, SweptAnglesAreThoseOfTheTable) {
  struct Row {
    double r, chi_deg, phi_deg;
  };
  for (const Row& row :
       {Row{15, 20, 302.96583194611962}, Row{15, 30, 196.281912128753012}, Row{15, 150, 32.2836169685154366},
        Row{6, 90, 119.074039498791064}, Row{30, 10, 338.975600480990709}}) {
    const auto phi = schwarzschild_sweep(1, rho_from_r(row.r), row.chi_deg * kDegree);
    ASSERT_TRUE(phi);
    EXPECT_NEAR(*phi / kDegree, row.phi_deg, 1e-11) << row.r << " " << row.chi_deg;
    EXPECT_NEAR(*schwarzschild_sweep(7e5, 7e5 * rho_from_r(row.r), row.chi_deg * kDegree), *phi, 1e-13);
  }
}

TEST(SchwarzschildSky, IsDarwinsAngleFromAfar) {
  for (const double b : {5.2, 6.0, 10.0, 100.0}) {
    const double r = 1e9;
    const double chi = chi_from_b(b, r);
    // From so far away the finite distance takes (m/r)(b/r) off.
    EXPECT_NEAR(*schwarzschild_sweep(1, rho_from_r(r), chi), kPi - chi + static_cast<double>(darwin(b)), 1e-8)
        << b;
  }
}

TEST(SchwarzschildSky, CurvedRaysAgreeOnAllSidesOfTheShadowAndOfTheSide) {
  for (const double r : {4.0, 10.0, 40.0}) {
    const double shadow = std::asin(std::sqrt(27 * (1 - 2 / r)) / r);
    for (const double chi : {shadow * 1.01, shadow * 1.5, kPi / 2 - 1e-3, kPi / 2 + 1e-3, 2.0,
                             kPi - shadow * 1.01, kPi - shadow * 0.99, 3.1}) {
      if (r == 4.0 && chi < shadow) continue;
      const auto phi = schwarzschild_sweep(1, rho_from_r(r), chi);
      ASSERT_TRUE(phi) << r << " " << chi;
      EXPECT_NEAR(without_full_turns(swept_angle(r, chi) - *phi), 0, 1e-12) << r << " " << chi;
    }
    EXPECT_FALSE(schwarzschild_sweep(1, rho_from_r(r), shadow * 0.999));
  }
}

TEST(SchwarzschildSky, SaysNothingWithinThePhotonSphere) {
  EXPECT_FALSE(schwarzschild_sweep(1, rho_from_r(2.99), 2.0));
  EXPECT_FALSE(schwarzschild_sweep(1, 0.4, 2.0));
  EXPECT_FALSE(schwarzschild_sweep(1, 0, 2.0));
}

TEST(SchwarzschildSky, DirectionsLieInThePlaneOfTheMass) {
  const Vec3 mass(3, 4, -12);
  const double m = mass.length() / rho_from_r(20);
  const Vec3 seen = Vec3(0.5, -0.2, -1).normalized();
  const auto sky = sky_direction_past(m, mass, seen);
  ASSERT_TRUE(sky);
  EXPECT_NEAR(sky->length(), 1, 1e-15);
  EXPECT_NEAR(sky->dot(mass.cross(seen)) / mass.length(), 0, 1e-15);
  // Towards the mass: what is seen on its left comes from farther right.
  EXPECT_GT(sky->dot(mass) / mass.length(), seen.dot(mass) / mass.length());
  // Straight away from the mass nothing is bent.
  EXPECT_NEAR((*sky_direction_past(m, mass, -mass.normalized()) + mass.normalized()).length(), 0, 1e-15);
}

}  // namespace
}  // namespace lensplane
