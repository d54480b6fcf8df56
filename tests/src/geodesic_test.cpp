// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "tests/src/scenes.h"
#include "tests/src/schwarzschild.h"

namespace lensplane {
namespace {

/// Deflection between both asymptotes of the ray with impact parameter b: it is followed from r_o = `r` both
/// ways. Exact, although r_o is finite; up to full turns.
double deflection(double b, double r, double tolerance = kFine) {
  const double chi = chi_from_b(b, r);
  return swept_angle(r, chi, tolerance) + swept_angle(r, kPi - chi, tolerance) - kPi;
}

constexpr std::pair<double, double> kDeflections[] = {
    {5.19616, 13.03805008693978029}, {5.1963, 10.06896361837861959}, {5.197, 8.321408085687579182},
    {5.2, 6.810371956663496872},     {5.21, 5.534916981253387650},   {5.25, 4.194799708234656276},
    {5.3, 3.557938042459651486},     {5.5, 2.553020182345338313},    {6, 1.719388310230168613},
    {7, 1.127639104731336301},       {8, 0.8587300180790952602},     {10, 0.5903957876058273212},
    {12, 0.4526054125988864328},     {15, 0.3363657260294845936},    {20, 0.2361359953884699044},
    {30, 0.1482480872727554238},     {50, 0.08508345038324747283},   {100, 0.04122253974927365171},
    {1000, 0.004011823809925364710}, {1e4, 4.00117852408192234e-4},  {1e6, 4.00001178101511779848e-6},
    {1e8, 4.000000117809728776e-8}};

TEST(Geodesic, IsBentByOneMassAsSchwarzschildSays) {
  for (const auto& [b, alpha] : kDeflections) {
    for (const double r : {1.5 * b, 10.0 * b}) {
      // As the angle itself depends on b, rounding positions moves it: by 1e-10 next to the photon sphere.
      const double rounding = 1e-15 * r * static_cast<double>(-darwin_slope(b));
      EXPECT_NEAR(without_full_turns(deflection(b, r) - alpha), 0,
                  1e-12 * std::min(alpha, 1.0) + 1e-15 + rounding)
          << "b = " << b << ", r = " << r;
    }
  }
}

TEST(Geodesic, SmallDeflectionsKeepTheirDigits) {
  // Past a mass far beside the way: to second order, with b = n0 rho sin(chi). The error is absolute.
  for (const double b : {1e8, 1e10}) {
    const double z = 1e3 * b, weak = 2.0 / b * (1.0 + z / std::hypot(z, b));
    const double bend = trace(std::array{PointMass{1.0, Vec3(b, 0, -z)}}, Vec3(0, 0, -1)).direction.x;
    EXPECT_NEAR(bend, weak * (1.0 + 15.0 * kPi / 16.0 / b - 2.0 / z), kFine) << b;
  }
}

TEST(Geodesic, SweepsTheAnglesOfAStaticObserver) {
  const std::array<std::array<double, 3>, 5> cases = {{{15, 20, 302.96583194611962},
                                                       {15, 30, 196.281912128753012},
                                                       {15, 150, 32.2836169685154366},
                                                       {6, 90, 119.074039498791064},
                                                       {30, 10, 338.975600480990709}}};
  for (const auto& [r, chi, phi] : cases) {
    EXPECT_NEAR(without_full_turns(swept_angle(r, chi * kDegree) - phi * kDegree), 0, 1e-11) << r;
  }
}

TEST(Geodesic, FinitePartOfTheDeflection) {
  // From r = 100 in to r = 100 out: from 200 to 200, less the stretches outside 100, which a ball cuts off.
  for (const auto& [b, alpha] :
       {std::pair(10.0, 0.588380712048563929), std::pair(20.0, 0.232075396741694592)}) {
    const double far = 200, near = 100, chi = chi_from_b(b, far);
    const auto masses = mass_ahead(far);
    const std::array ball = {Ball{masses[0].position, rho_from_r(near)}};
    const auto hit = trace(masses, at_angle(chi), kFine, ball).hits[0];
    ASSERT_TRUE(hit.hit);
    const Vec3 foot = hit.point - masses[0].position;
    const double outside = std::atan2(foot.x, foot.z);
    const double swept = swept_angle(far, chi) - swept_angle(far, kPi - chi);
    EXPECT_NEAR(without_full_turns(swept - 2.0 * outside + 2.0 * chi_from_b(b, near) - kPi - alpha), 0,
                1e-13);
  }
}

/// The angle between `captured` and `free`, both from the direction of the mass, where capture ends.
double edge_of_capture(double r, double captured, double free) {
  const auto masses = mass_ahead(r);
  EXPECT_TRUE(trace(masses, at_angle(captured), 1e-12).captured);
  EXPECT_FALSE(trace(masses, at_angle(free), 1e-12).captured);
  while (std::abs(captured - free) > 1e-10) {
    const double middle = 0.5 * (captured + free);
    (trace(masses, at_angle(middle), 1e-12).captured ? captured : free) = middle;
  }
  return captured;
}

TEST(Geodesic, ShadowHasTheSizeThatAStaticObserverSees) {
  const std::pair<double, double> shadows[] = {{3, 90},
                                               {4, 66.7162682788948858},
                                               {6, 45},
                                               {10, 27.6945614507767685},
                                               {30, 9.63273228269725334},
                                               {100, 2.94855519767807879}};
  for (const auto& [r, degrees] : shadows) {
    EXPECT_NEAR(edge_of_capture(r, 0.0, kPi) / kDegree, degrees, 1e-7) << r;
  }
}

TEST(Geodesic, LightEscapesFromInsideThePhotonSphereWhenItMovesOut) {
  for (const double r : {2.001, 2.1, 2.5, 2.9}) {
    const double escape_cone = std::asin(kCritical * std::sqrt(1.0 - 2.0 / r) / r);
    EXPECT_NEAR(edge_of_capture(r, 0.5 * kPi, kPi), kPi - escape_cone, 1e-9) << r;
  }
}

TEST(Geodesic, IsCapturedAtOnceOnAMassOrItsHorizon) {
  const Vec3 away(0, 0, 1);
  for (const double rho : {0.0, 0.1, 0.5}) {
    EXPECT_TRUE(trace(std::array{PointMass{1.0, Vec3(0, 0, -rho)}}, away).captured) << rho;
  }
  EXPECT_FALSE(trace(std::array{PointMass{1.0, Vec3(0, 0, -0.51)}}, away).captured);
  EXPECT_TRUE(trace(std::array{PointMass{1.0, Vec3(0, 0, -0.51)}}, -away).captured);
}

TEST(Geodesic, ErrorsStayWithinTheToleranceAndFallWithIt) {
  for (const double b : {6.0, 8.0, 12.0, 30.0, 1000.0}) {
    const double exact = static_cast<double>(darwin(b));
    const double enlarged = 1.0 + b * static_cast<double>(-darwin_slope(b));
    double worst_before = 1.0;
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
      const double error = std::abs(without_full_turns(deflection(b, 10.0 * b, tolerance) - exact));
      EXPECT_LT(error, 4.0 * enlarged * tolerance) << b;
      EXPECT_LT(error, 0.2 * worst_before + 1e-15) << b;
      worst_before = std::max(error, tolerance);
    }
  }
}

}  // namespace
}  // namespace lensplane
