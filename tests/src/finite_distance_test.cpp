// SPDX-License-Identifier: Apache-2.0
//
// The method `planes` for a camera at a finite distance: against what a static observer near a Schwarzschild
// mass sees, and against curved rays.

#include <gtest/gtest.h>

#include <cmath>

#include "src/geodesic.h"
#include "src/planes_march.h"
#include "tests/src/deflector_scenes.h"

namespace lensplane {
namespace {

constexpr double kDegree = kPi / 180;

/// A mass of 1 ahead of a lat-long camera at Schwarzschild radius r.
Deflectors mass_ahead(double r, Law law = Law::Exact) {
  return round_deflectors({{1, {0, 0, -isotropic_radius(r)}}}, law);
}

RayPath<double> path_at(const Deflectors& deflectors, double angle) {
  return march_planes<double>(deflectors, at_angle(angle));
}

/// The bend of the ray at this angle from the direction of the mass.
double bend_at(const Deflectors& deflectors, double angle) {
  const auto path = path_at(deflectors, angle);
  EXPECT_EQ(path.bends, 1);
  return path.passages.at(0).alpha;
}

/// The radius of the dark disc round the direction of the mass.
double shadow(const Deflectors& deflectors) {
  double dark = 0, bright = kPi;
  EXPECT_TRUE(path_at(deflectors, dark).captured);
  EXPECT_FALSE(path_at(deflectors, bright).captured);
  for (int i = 0; i < 60; ++i) {
    const double middle = (dark + bright) / 2;
    (path_at(deflectors, middle).captured ? dark : bright) = middle;
  }
  return dark;
}

TEST(FiniteDistance, ShadowHasTheSizeThatAStaticObserverSees) {
  const std::pair<double, double> published[] = {{4, 66.7162682788948858},
                                                 {6, 45},
                                                 {10, 27.6945614507767685},
                                                 {30, 9.63273228269725334},
                                                 {100, 2.94855519767807879}};
  for (const auto& [r, degrees] : published) {
    for (const LawEntry& law : kLaws) {
      EXPECT_NEAR(shadow(mass_ahead(r, law.law)) / kDegree, degrees, 1e-13 * degrees * r) << r;
      const auto lens = Lens{1, {0, 0, -isotropic_radius(r)}};
      EXPECT_NEAR(shadow(flat_deflectors({lens}, law.law, true)) / kDegree, degrees, 1e-13 * degrees * r);
    }
  }
  // On the photon sphere it is half the sky. There the sine of its radius is at its maximum.
  EXPECT_NEAR(shadow(mass_ahead(3)) / kDegree, 90, 1e-6);
}

TEST(FiniteDistance, InsideThePhotonSphereLightComesFromACircleRoundStraightAway) {
  for (const double r : {2.0001, 2.1, 2.5, 2.9, 2.999}) {
    const double bright = std::asin(std::sqrt(27 * (1 - 2 / r)) / r);
    EXPECT_NEAR(kPi - shadow(mass_ahead(r)), bright, 1e-11) << r;
  }
  EXPECT_TRUE(path_at(round_deflectors({{1, {0, 0, -0.4999}}}, Law::Exact), kPi).captured);
}

TEST(FiniteDistance, BendsAreThoseOfAStaticObserver) {
  // phi is the angle about the mass from the observer to where the ray leaves; phi = pi - chi + alpha. What
  // is left out are the higher orders' shares ahead of the camera, h(cos R): nothing beside the mass, the
  // more the more of the bend is behind.
  struct {
    double r, chi, phi, error;  // degrees; error: share of the bend, measured
  } constexpr kPublished[] = {{15, 20, 302.96583194611962, 2.1e-4},
                              {15, 30, 196.281912128753012, 2.7e-3},
                              {15, 150, 32.2836169685154366, 0.15},
                              {6, 90, 119.074039498791064, 1e-14},
                              {30, 10, 338.975600480990709, 4.5e-5}};
  for (const auto& [r, chi, phi, error] : kPublished) {
    const double alpha = (phi - 180 + chi) * kDegree;
    EXPECT_NEAR(bend_at(mass_ahead(r), chi * kDegree) / alpha, 1, error) << r << " " << chi;
  }
}

TEST(FiniteDistance, BendsOfADistantObserverLackTheirFinitePart) {
  // Published for r_R = r_S = r; with the light's source at infinity half of what is missing comes back. Of
  // that the formula knows all but 2.2 %.
  struct {
    double b, r, finite, whole;
  } constexpr kPublished[] = {{10, 100, 0.588380712048563929, 0.5903957876058273212},
                              {20, 100, 0.232075396741694592, 0.2361359953884699044}};
  for (const auto& [b, r, finite, whole] : kPublished) {
    const double missing = (whole - finite) / 2;
    const double chi = std::asin(b * std::sqrt(1 - 2 / r) / r);
    EXPECT_NEAR(bend_at(mass_ahead(r), chi), whole - missing, 0.022 * missing) << b;
    EXPECT_LT(bend_at(mass_ahead(r), chi), whole);
  }
}

TEST(FiniteDistance, PicturesHaveNoSeamAnywhereOnTheSphere) {
  for (const LawEntry& law : kLaws) {
    const Deflectors deflectors = mass_ahead(20, law.law);
    const auto slope = [&](double angle) {
      const DualVec3 first = dual_vector(at_angle(angle), at_angle(angle + kPi / 2), {0, 1, 0});
      const auto path = march_planes<Dual>(deflectors, first);
      return derivative_by_x(path.segments.back().direction);
    };
    // All the way round, past the right angle and straight away, no step is larger than the steepest slope.
    const double h = 1e-4, steepest = 1.05 * slope(0.4).length();
    for (double angle = 0.4; angle < 2 * kPi - 0.4; angle += h) {
      const auto here = path_at(deflectors, angle), next = path_at(deflectors, angle + h);
      const Vec3 step = next.segments.back().direction - here.segments.back().direction;
      ASSERT_LT(step.length(), steepest * h) << law.name << " " << angle;
    }
    // Across those two places the picture and its derivatives are continuous to the last digits.
    for (const double angle : {kPi / 2, kPi}) {
      const auto left = path_at(deflectors, angle - 1e-14), right = path_at(deflectors, angle + 1e-14);
      EXPECT_NEAR((left.segments.back().direction - right.segments.back().direction).length(), 0, 1e-13);
      EXPECT_NEAR((left.segments.back().start - right.segments.back().start).length(), 0, 2e-12);
      EXPECT_NEAR((slope(angle - 1e-9) - slope(angle + 1e-9)).length(), 0, 1e-8) << law.name << " " << angle;
      EXPECT_TRUE(std::isfinite(slope(angle).length()));
    }
  }
}

TEST(FiniteDistance, MassThatPassesTheCameraMakesNoJump) {
  const double distance = 20;
  for (Vec3 direction : {Vec3(0.1, 0.2, -1), Vec3(0.9, 0.1, -1), Vec3(-0.5, 0.3, -1)}) {
    direction.normalize();
    const auto at = [&](double z) {
      const auto path =
          march_planes<double>(flat_deflectors({{1, {distance, 2, z}}}, Law::Exact, true), direction);
      return path.segments.back();
    };
    for (const double share : {1e-3, 1e-6, 1e-9, 1e-12}) {
      const double z = share * distance;
      EXPECT_LT((at(z).direction - at(-z).direction).length(), share) << share;
      EXPECT_LT((at(z).start - at(-z).start).length(), 3 * z) << share;
      EXPECT_LT((at(0).direction - at(-z).direction).length(), share) << share;
    }
    // On the way past it bends throughout: half as much beside the camera as ahead, nothing far behind.
    EXPECT_GT(angle_between(at(0).direction, direction), 0.01);
    EXPECT_LT(angle_between(at(1e6).direction, direction), 1e-6);
  }
}

/// The angle between the directions by `planes` and by curved rays.
double error_of(const std::vector<Lens>& lenses, double angle) {
  std::vector<PointMass> masses;
  for (const Lens& lens : lenses) masses.push_back({lens.m, lens.position});
  const auto curved = trace_geodesic<double>(masses, Vec3(0), at_angle(angle), 1e-16);
  return angle_between(path_at(round_deflectors(lenses, Law::Exact), angle).segments.back().direction,
                       curved.direction);
}

TEST(FiniteDistance, WeakBendsAgreeWithCurvedRaysToFirstOrder) {
  for (const double angle : {0.05, 0.3, 1.0, 1.5, 2.0, 2.8, 3.1}) {
    const auto error = [&](double m) { return error_of({{m, {0, 0, -1}}}, angle); };
    // What is left is of second order: about m^2 at unit distance, and a hundredth of that when m is a tenth.
    EXPECT_LT(error(1e-4), 1.1e-8) << angle;
    EXPECT_NEAR(error(1e-4) / error(1e-3), 0.01, 1e-4) << angle;
  }
}

TEST(FiniteDistance, SeveralWeakBendsAgreeWithCurvedRaysToFirstOrder) {
  // Masses ahead, beside and behind: their pairs give errors of second order, too.
  for (const double angle : {-0.4, 0.1, 0.9, 1.7, 3.0}) {
    const auto error = [&](double m) {
      return error_of({{m, {0.1, 0.2, -1}}, {m, {-0.3, 0.2, -2}}, {m, {1, 0.5, 0}}, {m, {0.2, 0.2, 1.5}}},
                      angle);
    };
    EXPECT_LT(error(1e-5), 1e-8) << angle;
    EXPECT_NEAR(error(1e-6) / error(1e-5), 0.01, 1e-3) << angle;
  }
}

TEST(FiniteDistance, LightThatComesBackIsBentAgainByAllThatItMeets) {
  // Round the mass ahead by half a turn, and past another behind the camera.
  const Lens ahead{1, {0, 0, -isotropic_radius(100)}}, behind{0.01, {4, 7, 60}};
  const double chi = std::asin(5.3569586 * std::sqrt(1 - 2.0 / 100) / 100);
  const auto path = path_at(round_deflectors({ahead, behind}, Law::Exact), chi);
  ASSERT_EQ(path.bends, 3);
  // On the way out the mass behind leaves a rest, on the way back it bends like any other.
  const double out = at_angle(chi).dot(behind.position);
  const double b = (behind.position - at_angle(chi) * out).length();
  EXPECT_EQ(path.passages[0].lens, 1U);
  EXPECT_NEAR(path.passages[0].alpha / (2 * 0.01 / b * (1 + out / behind.position.length())), 1, 2e-3);
  const RaySegment<double>& back = path.segments[4];
  EXPECT_GT(back.direction.z, 0.99);
  const Vec3 to_mass = behind.position - back.start;
  const double b_back = (to_mass - back.direction * to_mass.dot(back.direction)).length();
  EXPECT_EQ(path.passages[2].lens, 1U);
  EXPECT_NEAR(angle_between(back.direction, path.segments[6].direction), exact_law(0.01, b_back).alpha,
              1e-13);
}

}  // namespace
}  // namespace lensplane
