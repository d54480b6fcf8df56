// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <functional>

#include "tests/src/schwarzschild.h"

namespace lensplane {
namespace {

// Schwarzschild, m = 1: coordinate time and isotropic length by the radius, for impact parameter b.

double time_by_radius(double r, double b) {
  const double f = 1.0 - 2.0 / r;
  return 1.0 / (f * std::sqrt(1.0 - b * b * f / (r * r)));
}
double length_by_radius(double r, double b) {
  const double f = 1.0 - 2.0 / r;
  return rho_from_r(r) / (r * std::sqrt(f * (1.0 - b * b * f / (r * r))));
}
double integral(const std::function<double(double)>& f, double from, double to) {
  return boost::math::quadrature::tanh_sinh<double>().integrate(f, from, to, 1e-12);
}

/// delay of a ray outward from r_o with impact parameter b that sweeps the angle phi.
double outward_delay(double r_o, double b, double phi) {
  const double rho_o = rho_from_r(r_o);
  const auto rest = [&](double u) {  // u = 1/r
    return u == 0.0 ? 4.0 + 0.5 * b * b : (time_by_radius(1.0 / u, b) - 1.0 - 2.0 * u) / (u * u);
  };
  // t(R) - rho(R) - 2 ln(R/rho_o) for R to infinity, and the projection of the start.
  return integral(rest, 1e-5, 1.0 / r_o) + 1e-5 * rest(0.0) + 1.0 - r_o + 2.0 * std::log(rho_o / r_o) +
         rho_o * std::cos(phi);
}

TEST(GeodesicDelay, DelayIsThatOfSchwarzschild) {
  const double r_o = 15;
  for (const double b : {1.0, 4.0, 8.0}) {
    const double chi = kPi - chi_from_b(b, r_o);
    const double delay = trace(mass_ahead(r_o), at_angle(chi)).delay;
    EXPECT_NEAR(delay, outward_delay(r_o, b, swept_angle(r_o, chi)), 1e-8) << b;
  }
  for (const double b : {5.3, 6.0, 8.0, 12.0}) {
    const double chi = chi_from_b(b, r_o);
    const double pericentre = 2.0 * b / std::sqrt(3.0) * std::cos(std::acos(-kCritical / b) / 3.0);
    // r = pericentre + u^2 takes the root out of the integrand.
    const auto time = [&](double u) {
      const double r = pericentre + u * u;
      const double cubic = (u * u + 3.0 * pericentre) * u * u + 3.0 * pericentre * pericentre - b * b;
      return 2.0 * r / (1.0 - 2.0 / r) * std::sqrt(r / cubic);
    };
    const double there_and_back = 2.0 * integral(time, 0.0, std::sqrt(r_o - pericentre));
    EXPECT_NEAR(trace(mass_ahead(r_o), at_angle(chi)).delay,
                there_and_back + outward_delay(r_o, b, swept_angle(r_o, chi)), 1e-8)
        << b;
  }
}

TEST(GeodesicDelay, DelayAndLengthUpToABallAreThoseOfSchwarzschild) {
  const double r_o = 40, r_ball = 9;
  const auto masses = mass_ahead(r_o);
  const std::array ball = {Ball{masses[0].position, rho_from_r(r_ball)}};
  for (const double b : {0.5, 5.0, 9.0}) {
    const auto hit = trace(masses, at_angle(chi_from_b(b, r_o)), kFine, ball).hits[0];
    ASSERT_TRUE(hit.hit);
    const double time = integral([&](double r) { return time_by_radius(r, b); }, r_ball, r_o);
    const double length = integral([&](double r) { return length_by_radius(r, b); }, r_ball, r_o);
    EXPECT_NEAR(hit.delay, time - hit.point.length(), 1e-12 * r_o);
    EXPECT_NEAR(hit.length, length, 1e-12 * r_o);
    EXPECT_NEAR((hit.point - masses[0].position).length(), rho_from_r(r_ball), 1e-14 * r_o);
  }
}

TEST(GeodesicDelay, DelayOfAThinMassIsShapiros) {
  const double m = 1477.0, distance = 1e14;
  for (const double angle : {1e-6, 1e-4, 0.1, 1.0}) {
    const std::array masses = {PointMass{m, at_angle(angle) * distance}};
    const double b = distance * std::sin(angle), z = distance * std::cos(angle);
    const double shapiro = 2.0 * m * std::log((z + std::hypot(z, b)) * 2.0 * distance / (b * b));
    const double alpha = 4.0 * m / b;
    const double rest = z * alpha * alpha;  // of second order
    EXPECT_NEAR(trace(masses, Vec3(0, 0, -1)).delay, shapiro, m * (1e-9 + 10 * kFine / alpha) + rest);
  }
}

}  // namespace
}  // namespace lensplane
