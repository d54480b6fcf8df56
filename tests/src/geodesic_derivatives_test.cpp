// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "tests/src/schwarzschild.h"

namespace lensplane {
namespace {

/// The derivative of what `f` makes of a ray by the angle `x` of the ray, from rays traced as finely as can
/// be.
Vec3 difference(const std::function<Vec3(double)>& f, double x, double h) {
  return ((f(x + h) - f(x - h)) * 45.0 - (f(x + 2 * h) - f(x - 2 * h)) * 9.0 + f(x + 3 * h) - f(x - 3 * h)) /
         (60.0 * h);
}

TEST(GeodesicDerivatives, DerivativesAreThoseOfTheRays) {
  const auto masses = three_masses();
  const std::array ball = {Ball{Vec3(-20, 5, -300), 120}};
  const auto direction = [](double x, double y) { return Vec3(x, y, -1).normalized(); };
  for (const auto& [x, y] : {std::pair(0.05, 0.02), std::pair(-0.06, 0.0), std::pair(0.01, -0.05)}) {
    const double norm = std::sqrt(1 + x * x + y * y);
    const Vec3 d = direction(x, y);
    const DualVec3 dual = dual_vector(d, (Vec3(1, 0, 0) - d * d.x) / norm, (Vec3(0, 1, 0) - d * d.y) / norm);
    const auto ray = trace_geodesic<Dual>(masses, DualVec3(Dual(0.0)), dual, 1e-13, {ball});
    ASSERT_FALSE(ray.captured);
    ASSERT_TRUE(ray.hits[0].hit);
    const auto compare = [&](const char* what, const DualVec3& ours, auto pick, double accuracy) {
      const auto picked = [&](double u, double v) {
        return pick(trace_geodesic<double>(masses, Vec3(0), direction(u, v), kFine, {ball}));
      };
      const Vec3 by_x = difference([&](double u) { return picked(u, y); }, x, 2e-5);
      const Vec3 by_y = difference([&](double v) { return picked(x, v); }, y, 2e-5);
      const double size = by_x.length() + by_y.length();
      EXPECT_NEAR((value_of(ours) - picked(x, y)).length(), 0, accuracy * size) << what;
      EXPECT_NEAR((derivative_by_x(ours) - by_x).length(), 0, accuracy * size) << what;
      EXPECT_NEAR((derivative_by_y(ours) - by_y).length(), 0, accuracy * size) << what;
    };
    using Ray = GeodesicRay<double>;
    compare(
        "direction", ray.direction, [](const Ray& r) { return r.direction; }, 1e-9);
    compare(
        "asymptote", ray.position, [](const Ray& r) { return r.position; }, 1e-7);
    compare(
        "point", ray.hits[0].point, [](const Ray& r) { return r.hits[0].point; }, 1e-9);
    const DualVec3 scalars(ray.delay, ray.hits[0].delay, ray.hits[0].length);
    compare(
        "delays and length", scalars,
        [](const Ray& r) { return Vec3(r.delay, r.hits[0].delay, r.hits[0].length); }, 1e-7);
  }
}

/// The derivative of the angle that a ray sweeps by the angle at which it leaves.
double swept_slope(double r, double chi, double tolerance) {
  const Vec3 along(std::cos(chi), 0, std::sin(chi));
  const DualVec3 dual = dual_vector(at_angle(chi), along, Vec3(0));
  const auto d = trace_geodesic<Dual>(mass_ahead(r), DualVec3(Dual(0.0)), dual, tolerance).direction;
  return atan2(d.x, d.z).dx;
}

TEST(GeodesicDerivatives, ByTheImpactParameterAreTheClosedForm) {
  for (const double b : {5.25, 6.0, 10.0, 100.0}) {
    const double r = 10.0 * b, chi = chi_from_b(b, r), db_dchi = r * std::cos(chi) / std::sqrt(1 - 2 / r);
    // Outward, chi' = pi - chi: the derivative by chi changes its sign.
    const double dalpha_db = (swept_slope(r, chi, 1e-13) - swept_slope(r, kPi - chi, 1e-13)) / db_dchi;
    const double exact = static_cast<double>(darwin_slope(b));
    EXPECT_NEAR(dalpha_db / exact, 1, 1e-10 + 1e-13 * r * std::abs(exact)) << b;
  }
}

TEST(GeodesicDerivatives, AreAsRightAsTheToleranceSays) {
  // The last is a distant lens: angles are small there, their derivatives are not.
  for (const auto& [b, r] :
       {std::pair(6.0, 60.0), std::pair(12.0, 120.0), std::pair(30.0, 300.0), std::pair(1500.0, 1e6)}) {
    const double chi = chi_from_b(b, r), enlarged = 1.0 - b * static_cast<double>(darwin_slope(b));
    const double exact = swept_slope(r, chi, kFine);
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      EXPECT_NEAR(swept_slope(r, chi, tolerance) / exact, 1, enlarged * tolerance) << b;
    }
  }
}

}  // namespace
}  // namespace lensplane
