// SPDX-License-Identifier: Apache-2.0
//
// Rays about one mass of 1, and what is known about them in closed form.

#pragma once

#include <gtest/gtest.h>

#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "src/constants.h"
#include "src/geodesic.h"

namespace lensplane {

inline constexpr double kFine = 1e-15;                  // tolerance where rounding is to be all that is left
inline constexpr double kCritical = 5.196152422706632;  // 3 sqrt(3)

/// Isotropic distance from a mass of 1 at Schwarzschild radius r.
inline double rho_from_r(double r) {
  return 0.5 * (r - 1.0 + std::sqrt(r * r - 2.0 * r));
}

/// Angle from the direction of the mass at which a static observer at `r` sees impact parameter `b`.
inline double chi_from_b(double b, double r) {
  return std::asin(b * std::sqrt(1.0 - 2.0 / r) / r);
}

/// A mass of 1 ahead, on -z, of an observer at the origin, at Schwarzschild radius r.
inline std::array<PointMass, 1> mass_ahead(double r) {
  return {PointMass{1.0, Vec3(0, 0, -rho_from_r(r))}};
}
inline Vec3 at_angle(double chi) {
  return {std::sin(chi), 0.0, -std::cos(chi)};
}

inline GeodesicRay<double> trace(std::span<const PointMass> masses, const Vec3& direction,
                                 double tolerance = kFine, std::span<const Ball> balls = {}) {
  return trace_geodesic<double>(masses, Vec3(0), direction, tolerance, {balls});
}

/// Angle about the mass from the observer to where the ray leaves for infinity, up to full turns.
inline double swept_angle(double r, double chi, double tolerance = kFine) {
  const auto ray = trace(mass_ahead(r), at_angle(chi), tolerance);
  EXPECT_FALSE(ray.captured) << "r = " << r << ", chi = " << chi;
  return std::atan2(ray.direction.x, ray.direction.z);
}

inline double without_full_turns(double angle) {
  return std::remainder(angle, 2.0 * kPi);
}

/// alpha(b) for m = 1 (Darwin 1959).
inline long double darwin(long double b) {
  const long double p = 2 * b / std::sqrt(3.0L) * std::cos(std::acos(-3 * std::sqrt(3.0L) / b) / 3);
  const long double q = std::sqrt((p - 2) * (p + 6));
  const long double k = std::sqrt((q - p + 6) / (2 * q));
  const long double z = std::asin(std::sqrt((q - p + 2) / (q - p + 6)));
  const long double pi = std::numbers::pi_v<long double>;
  return 4 * std::sqrt(p / q) * (boost::math::ellint_1(k) - boost::math::ellint_1(k, z)) - pi;
}

inline long double darwin_slope(long double b) {
  const long double h = 1e-3L * (b - 3 * std::sqrt(3.0L));
  const auto difference = [&](int k) { return (darwin(b + k * h) - darwin(b - k * h)) / h; };
  return (45 * difference(1) - 9 * difference(2) + difference(3)) / 60;
}

/// Masses whose fields are strong enough to tell orders apart.
inline std::vector<PointMass> three_masses() {
  return {{0.2, {6.0, 1.0, -40.0}}, {0.15, {-9.0, 3.0, -75.0}}, {0.3, {2.0, -14.0, -120.0}}};
}

}  // namespace lensplane
