// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <utility>

#include "src/constants.h"

namespace lensplane {
namespace {

constexpr double kFine = 1e-15;  // tolerance where rounding is to be all that is left
constexpr double kDegree = kPi / 180.0;
constexpr double kCritical = 5.196152422706632;  // 3 sqrt(3)

/// Isotropic distance from a mass of 1 at Schwarzschild radius r.
double rho_from_r(double r) {
  return 0.5 * (r - 1.0 + std::sqrt(r * r - 2.0 * r));
}

/// Angle from the direction of the mass at which a static observer at `r` sees impact parameter `b`.
double chi_from_b(double b, double r) {
  return std::asin(b * std::sqrt(1.0 - 2.0 / r) / r);
}

/// A mass of 1 ahead, on -z, of an observer at the origin, at Schwarzschild radius r.
std::array<PointMass, 1> mass_ahead(double r) {
  return {PointMass{1.0, Vec3(0, 0, -rho_from_r(r))}};
}
Vec3 at_angle(double chi) {
  return {std::sin(chi), 0.0, -std::cos(chi)};
}

GeodesicRay<double> trace(std::span<const PointMass> masses, const Vec3& direction, double tolerance = kFine,
                          std::span<const Ball> balls = {}) {
  return trace_geodesic<double>(masses, Vec3(0), direction, tolerance, balls);
}

/// Angle about the mass from the observer to where the ray leaves for infinity, up to full turns.
double swept_angle(double r, double chi, double tolerance = kFine) {
  const auto ray = trace(mass_ahead(r), at_angle(chi), tolerance);
  EXPECT_FALSE(ray.captured) << "r = " << r << ", chi = " << chi;
  return std::atan2(ray.direction.x, ray.direction.z);
}

/// Deflection between both asymptotes of the ray with impact parameter b: it is followed from r_o = `r` both
/// ways. Exact, although r_o is finite; up to full turns.
double deflection(double b, double r, double tolerance = kFine) {
  const double chi = chi_from_b(b, r);
  return swept_angle(r, chi, tolerance) + swept_angle(r, kPi - chi, tolerance) - kPi;
}

double without_full_turns(double angle) {
  return std::remainder(angle, 2.0 * kPi);
}

/// alpha(b) for m = 1 (Darwin 1959).
long double darwin(long double b) {
  const long double p = 2 * b / std::sqrt(3.0L) * std::cos(std::acos(-3 * std::sqrt(3.0L) / b) / 3);
  const long double q = std::sqrt((p - 2) * (p + 6));
  const long double k = std::sqrt((q - p + 6) / (2 * q));
  const long double z = std::asin(std::sqrt((q - p + 2) / (q - p + 6)));
  const long double pi = std::numbers::pi_v<long double>;
  return 4 * std::sqrt(p / q) * (boost::math::ellint_1(k) - boost::math::ellint_1(k, z)) - pi;
}

long double darwin_slope(long double b) {
  const long double h = 1e-3L * (b - 3 * std::sqrt(3.0L));
  const auto difference = [&](int k) { return (darwin(b + k * h) - darwin(b - k * h)) / h; };
  return (45 * difference(1) - 9 * difference(2) + difference(3)) / 60;
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

std::vector<PointMass> three_masses() {
  return {{0.2, {6.0, 1.0, -40.0}}, {0.15, {-9.0, 3.0, -75.0}}, {0.3, {2.0, -14.0, -120.0}}};
}

TEST(Geodesic, SeveralThinMassesAddUp) {
  std::vector<PointMass> masses = three_masses();
  for (PointMass& mass : masses) mass.m *= 1e-9;
  Vec3 bend(0);
  for (const PointMass& mass : masses) {
    const Vec3 b(mass.position.x, mass.position.y, 0);
    bend += b / b.dot(b) * 2.0 * mass.m * (1.0 - mass.position.z / mass.position.length());
  }
  const Vec3 end = trace(masses, Vec3(0, 0, -1)).direction;
  EXPECT_NEAR(end.x, bend.x, 1e-16);  // of 1e-9: the rest is of second order
  EXPECT_NEAR(end.y, bend.y, 1e-16);
}

TEST(Geodesic, LightRunsBackTheWayItCame) {
  const auto masses = three_masses();
  const std::array far = {Ball{Vec3(0, 0, -1000), 700}};
  const std::array home = {Ball{Vec3(0), 1e-3}};
  for (const Vec3& d : {Vec3(0, 0, -1), Vec3(0.3, 0, -1), Vec3(-0.1, 0.2, -1), Vec3(0.02, 0.05, -1)}) {
    const auto there = trace(masses, d.normalized(), kFine, far).hits[0];
    ASSERT_TRUE(there.hit);
    const auto back = trace_geodesic<double>(masses, there.point, -there.direction, kFine, home).hits[0];
    ASSERT_TRUE(back.hit);
    EXPECT_NEAR(back.point.cross(back.direction).length(), 0, 1e-10);  // passes the camera
    EXPECT_NEAR((back.direction + d.normalized()).length(), 0, 1e-6);  // bends on over the last millimetre
    EXPECT_NEAR(back.length + 1e-3, there.length, 1e-9);
  }
}

TEST(Geodesic, TurnsWithTheScene) {
  const Basis turn = basis_from_zxy({0.4, -1.3, 2.2});
  auto masses = three_masses();
  const Vec3 d = Vec3(0.05, 0.02, -1).normalized();
  const std::array ball = {Ball{Vec3(-20, 5, -300), 120}};
  const std::array turned_ball = {Ball{turn.parent_from_local(ball[0].centre), 120}};
  const auto ray = trace(masses, d, 1e-13, ball);
  for (PointMass& mass : masses) mass.position = turn.parent_from_local(mass.position);
  const auto turned = trace(masses, turn.parent_from_local(d), 1e-13, turned_ball);
  EXPECT_NEAR((turned.direction - turn.parent_from_local(ray.direction)).length(), 0, 1e-13);
  EXPECT_NEAR((turned.position - turn.parent_from_local(ray.position)).length(), 0, 1e-8);
  EXPECT_NEAR(turned.delay, ray.delay, 1e-9);
  ASSERT_TRUE(ray.hits[0].hit && turned.hits[0].hit);
  EXPECT_NEAR((turned.hits[0].point - turn.parent_from_local(ray.hits[0].point)).length(), 0, 1e-10);
  EXPECT_NEAR(turned.hits[0].delay, ray.hits[0].delay, 1e-11);
}

TEST(Geodesic, DoesNotCareAboutTheUnitOfLength) {
  auto masses = three_masses();
  const Vec3 d = Vec3(0.05, 0.02, -1).normalized();
  const auto ray = trace(masses, d, 1e-12);
  for (const double scale : {0x1p-60, 0x1p80}) {
    auto scaled = masses;
    for (PointMass& mass : scaled) mass.m *= scale, mass.position *= scale;
    EXPECT_EQ(trace(scaled, d, 1e-12).direction, ray.direction);
  }
}

TEST(Geodesic, WithoutMassIsStraightBitForBit) {
  const Vec3 start(0.3, -7.0, 11.0), d = Vec3(0.1, 0.7, -0.3).normalized();
  const std::array none = {PointMass{0, start}, PointMass{0, start + d}};
  const std::array ball = {Ball{start + d * 10.0, 2.0}, Ball{start, 1.0}, Ball{start - d * 10.0, 2.0}};
  for (const std::span<const PointMass> masses :
       {std::span<const PointMass>(), std::span<const PointMass>(none)}) {
    const auto ray = trace_geodesic<double>(masses, start, d, 1e-9, ball);
    EXPECT_FALSE(ray.captured);
    EXPECT_EQ(ray.direction, d);
    EXPECT_EQ(ray.position, start);
    EXPECT_EQ(ray.delay, 0.0);
    ASSERT_TRUE(ray.hits[0].hit);
    EXPECT_NEAR(ray.hits[0].length, 8.0, 1e-14);
    EXPECT_NEAR((ray.hits[0].point - start - d * 8.0).length(), 0, 1e-14);
    EXPECT_NEAR(ray.hits[0].delay, 0, 1e-14);
    EXPECT_FALSE(ray.hits[1].hit);  // leaves it
    EXPECT_FALSE(ray.hits[2].hit);  // behind
  }
}

TEST(Geodesic, MassesOfZeroChangeNothing) {
  auto masses = three_masses();
  const Vec3 d = Vec3(0.05, 0.02, -1).normalized();
  const auto ray = trace(masses, d, 1e-9);
  masses.insert(masses.begin() + 1, {0.0, Vec3(0)});
  EXPECT_EQ(trace(masses, d, 1e-9).direction, ray.direction);
}

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

TEST(Geodesic, DelayIsThatOfSchwarzschild) {
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

TEST(Geodesic, DelayAndLengthUpToABallAreThoseOfSchwarzschild) {
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

TEST(Geodesic, DelayOfAThinMassIsShapiros) {
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

TEST(Geodesic, ThinStepsDoNotMissASmallBall) {
  // Balls from a tenth to 1e-7 of the way, met in the middle and close to the edge, far behind the mass.
  const std::array masses = {PointMass{1.0, Vec3(300, 0, -1e4)}};
  for (const double distance : {3e3, 1.1e4, 1e6, 1e9}) {
    const std::array screen = {Ball{Vec3(0, 0, -2 * distance), distance}};
    const auto there = trace(masses, Vec3(0, 0, -1), kFine, screen).hits[0];
    ASSERT_TRUE(there.hit);
    const Vec3 across = Vec3(0, 1, 0);
    for (const double radius : {0.1 * distance, 1e-3 * distance, 1e-7 * distance}) {
      for (const double offset : {0.0, 0.5, 0.99, 1.01, 2.0}) {
        const std::array ball = {Ball{there.point + across * (offset * radius), radius}};
        for (const double tolerance : {1e-4, 1e-9}) {
          const auto hit = trace(masses, Vec3(0, 0, -1), tolerance, ball).hits[0];
          const bool certain = 1e-3 * radius > tolerance * distance;
          if (!certain) continue;
          EXPECT_EQ(hit.hit, offset < 1.0) << distance << ' ' << radius << ' ' << offset;
          if (hit.hit) {
            EXPECT_NEAR((hit.point - ball[0].centre).length(), radius, 1e-14 * distance);
            const double before = std::sqrt(1.0 - offset * offset) * radius;
            EXPECT_NEAR(there.length - hit.length, before, 2.0 * tolerance * distance + 0.1 * before);
          }
        }
      }
    }
  }
}

TEST(Geodesic, HitsABallBeforeItIsCaptured) {
  const auto masses = mass_ahead(30);
  const std::array balls = {Ball{masses[0].position, 4.0}, Ball{masses[0].position, 0.1}};
  const auto ray = trace(masses, Vec3(0, 0, -1), 1e-9, balls);
  EXPECT_TRUE(ray.captured);
  ASSERT_TRUE(ray.hits[0].hit);
  EXPECT_NEAR(ray.hits[0].length, rho_from_r(30) - 4.0, 1e-8);
  EXPECT_FALSE(ray.hits[1].hit);
  EXPECT_EQ(ray.direction, Vec3(0));
}

/// The derivative of what `f` makes of a ray by the angle `x` of the ray, from rays traced as finely as can
/// be.
Vec3 difference(const std::function<Vec3(double)>& f, double x, double h) {
  return ((f(x + h) - f(x - h)) * 45.0 - (f(x + 2 * h) - f(x - 2 * h)) * 9.0 + f(x + 3 * h) - f(x - 3 * h)) /
         (60.0 * h);
}

TEST(Geodesic, DerivativesAreThoseOfTheRays) {
  const auto masses = three_masses();
  const std::array ball = {Ball{Vec3(-20, 5, -300), 120}};
  const auto direction = [](double x, double y) { return Vec3(x, y, -1).normalized(); };
  for (const auto& [x, y] : {std::pair(0.05, 0.02), std::pair(-0.06, 0.0), std::pair(0.01, -0.05)}) {
    const double norm = std::sqrt(1 + x * x + y * y);
    const Vec3 d = direction(x, y);
    const DualVec3 dual = dual_vector(d, (Vec3(1, 0, 0) - d * d.x) / norm, (Vec3(0, 1, 0) - d * d.y) / norm);
    const auto ray = trace_geodesic<Dual>(masses, DualVec3(Dual(0.0)), dual, 1e-13, ball);
    ASSERT_FALSE(ray.captured);
    ASSERT_TRUE(ray.hits[0].hit);
    const auto compare = [&](const char* what, const DualVec3& ours, auto pick, double accuracy) {
      const auto picked = [&](double u, double v) {
        return pick(trace_geodesic<double>(masses, Vec3(0), direction(u, v), kFine, ball));
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

TEST(Geodesic, DerivativeByImpactParameterIsTheClosedForm) {
  for (const double b : {5.25, 6.0, 10.0, 100.0}) {
    const double r = 10.0 * b, chi = chi_from_b(b, r), db_dchi = r * std::cos(chi) / std::sqrt(1 - 2 / r);
    const auto masses = mass_ahead(r);
    const auto slope = [&](double angle) {  // of the swept angle by `angle`
      const Vec3 along(std::cos(angle), 0, std::sin(angle));
      const DualVec3 dual = dual_vector(at_angle(angle), along, Vec3(0));
      const auto d = trace_geodesic<Dual>(masses, DualVec3(Dual(0.0)), dual, 1e-13).direction;
      return atan2(d.x, d.z).dx;
    };
    // Outward, chi' = pi - chi: the derivative by chi changes its sign.
    const double dalpha_db = (slope(chi) - slope(kPi - chi)) / db_dchi;
    const double exact = static_cast<double>(darwin_slope(b));
    EXPECT_NEAR(dalpha_db / exact, 1, 1e-10 + 1e-13 * r * std::abs(exact)) << b;
  }
}

template <class N>
bool all_finite(const GeodesicRay<N>& ray) {
  const auto finite = [](const auto& v) {
    double sum = 0.0;
    for (const auto& k : {v.x, v.y, v.z}) {
      if constexpr (std::is_same_v<N, Dual>) sum += k.v + k.dx + k.dy;
      if constexpr (!std::is_same_v<N, Dual>) sum += k;
    }
    return std::isfinite(sum);
  };
  bool result = finite(ray.direction) && finite(ray.position) && finite(Vector<N>(ray.delay, N(0.0), N(0.0)));
  for (const BallHit<N>& hit : ray.hits) {
    result = result && finite(hit.point) && finite(Vector<N>(hit.length, hit.delay, N(0.0)));
  }
  return result;
}

TEST(Geodesic, IsFiniteWhateverTheStart) {
  const std::array scales = {0.0, 1e-300, 1e-160, 1e-20, 0.5, 1.0, 3.0, 1e10, 1e25, 1e160, 1e300};
  for (const double x : scales) {
    for (const double z : scales) {
      for (const double m : {1e-300, 1.0, 1e20}) {
        const std::array masses = {PointMass{m, Vec3(x, 0, -z)}, PointMass{1.0, Vec3(-4, 1, -7)}};
        const std::array balls = {Ball{Vec3(0, 0, -10), 3}, Ball{Vec3(x, 0, -z), 1}};
        EXPECT_TRUE(all_finite(trace(masses, Vec3(0, 0, -1), 1e-6, balls))) << x << ' ' << z << ' ' << m;
        const DualVec3 d = dual_vector(Vec3(0, 0, -1), Vec3(1e-3, 0, 0), Vec3(0, 1e-3, 0));
        EXPECT_TRUE(all_finite(trace_geodesic<Dual>(masses, DualVec3(Dual(0.0)), d, 1e-6, balls)))
            << x << ' ' << z << ' ' << m;
      }
    }
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

}  // namespace
}  // namespace lensplane
