// SPDX-License-Identifier: Apache-2.0
//
// Delays by all methods, against closed forms in a hundred digits, where they are a part in 1e24 of the way
// and where they are as long as the way.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "src/arrival_time.h"
#include "src/geodesic.h"
#include "src/march.h"
#include "src/planes_march.h"
#include "src/surfaces.h"
#include "tests/src/deflector_scenes.h"
#include "tests/src/exact_delay.h"

namespace lensplane {
namespace {

constexpr std::array kEinsteinAngles = {1.0, 0.3, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
constexpr std::array kImages = {1.618033988749895, 0.6180339887498949, 3.0};  // over the Einstein angle

/// A mass of 1 ahead, at the distance at which its Einstein angle for light from infinity is `angle`.
double distance_of(double angle) {
  return 4.0 / (angle * angle);
}

Vec3 direction_at(double angle) {
  return Vec3(std::tan(angle), 0, -1).normalized();
}

/// What `planes` says of light past one mass, of 1, by a law without finite distance, in many digits. With
/// the way z to the closest approach: z (1 - cos alpha) + 2 ln((z + hypot(z, b)) 2 D/b^2) + w + b (alpha -
/// sin alpha).
double exactly_by_planes(double distance, const Vec3& direction, Law law) {
  const Precise x = direction.x, forward = -Precise(direction.z), d = distance;
  const Precise size = sqrt(x * x + forward * forward);
  const Precise b = d * x / size, z = d * forward / size;
  const Precise second = 15 * boost::math::constants::pi<Precise>() / 4;
  const bool weak = law == Law::Weak;
  const Precise alpha = 4 / b + (weak ? Precise(0) : Precise(second / (b * b)));
  const Precise w = weak ? Precise(0) : Precise(second / b), half = sin(alpha / 2);
  const Precise shapiro = 2 * log((z + sqrt(z * z + b * b)) * 2 * d / (b * b));
  return static_cast<double>(2 * z * half * half + shapiro + w + b * (alpha - sin(alpha)));
}

double by_planes(double distance, const Vec3& direction, Law law) {
  Deflectors deflectors;
  deflectors.planes = {{Vec3(0, 0, -distance), {{1.0, Vec3(0, 0, -distance), law}}}};
  deflectors.outward = 1;
  return meet(LatLong{}, Camera{}, {0, 0}, march_planes<double>(deflectors, direction)).delay;
}

TEST(PreciseDelay, ByPlanesIsTheSumToTheLastDigits) {
  for (const double angle : kEinsteinAngles) {
    for (const double image : kImages) {
      if (angle * image > 1.3) continue;
      const double distance = distance_of(angle);
      const Vec3 direction = direction_at(angle * image);
      for (const Law law : {Law::Weak, Law::SecondOrder}) {
        if (distance * direction.x < 6.0) continue;  // captured
        const double exact = exactly_by_planes(distance, direction, law);
        EXPECT_NEAR(by_planes(distance, direction, law) / exact, 1, 1e-13) << angle << ' ' << image;
      }
    }
  }
}

TEST(PreciseDelay, ByThePapersMethodIsTheSumToTheLastDigits) {
  // Without an arc: the crossing point stays where it is, and b is measured in the plane.
  for (const double angle : kEinsteinAngles) {
    for (const double image : kImages) {
      if (angle * image > 1.3) continue;
      const double distance = distance_of(angle);
      const Vec3 direction = direction_at(angle * image);
      const auto path =
          march<double>({{{0, 0, -1}, distance, {{1.0, {0, 0, -distance}}}}}, Vec3(0), direction);
      const Precise x = direction.x, forward = -Precise(direction.z), d = distance;
      const Precise b = d * x / forward, way = d * sqrt(x * x + forward * forward) / forward;
      const Precise half = sin(2 / b);
      const Precise exact =
          2 * way * half * half + 2 * log((way + sqrt(way * way + b * b)) * 2 * d / (b * b));
      const double ours = meet(LatLong{}, Camera{}, {0, 0}, path).delay;
      EXPECT_NEAR(ours / static_cast<double>(exact), 1, 1e-13) << angle << ' ' << image;
    }
  }
}

TEST(PreciseDelay, OfCurvedRaysIsSchwarzschilds) {
  for (const double angle : kEinsteinAngles) {
    for (const double image : kImages) {
      const double distance = distance_of(angle);
      const Vec3 direction = direction_at(angle * image);
      if (distance * direction.x < 7.0) continue;
      const ExactDelay exact = exact_delay(1.0, distance, direction.x, -direction.z);
      const std::array masses = {PointMass{1.0, Vec3(0, 0, -distance)}};
      // As narrow views of that angle ask for, which is much less than their delays need.
      const double tolerance = std::max(kFinestTolerance, 0.005 * 6.0 * angle / 960.0);
      const auto ray = trace_geodesic<double>(masses, Vec3(0), direction, tolerance);
      EXPECT_NEAR(ray.delay / exact.delay, 1, 1e-9) << angle << ' ' << image;
    }
  }
}

TEST(PreciseDelay, ByPlanesIsSchwarzschildsToTheThirdOrder) {
  // Without higher orders it would be short by 0.2 to 7 % for light that passes within 100 to 6 m.
  const double distance = 1e4;
  for (const double b : {5.5, 6.0, 8.0, 12.0, 30.0, 100.0}) {
    const double sine = b / distance, cosine = std::sqrt(1.0 - sine * sine);
    const std::vector<Lens> lenses = {{1.0, {0, 0, -distance}}};
    Deflectors deflectors = round_deflectors(lenses, Law::Exact);
    const Vec3 direction(sine, 0, -cosine);
    const double exact = exact_delay(1.0, distance, sine, cosine).delay;
    const double ours = meet(LatLong{}, Camera{}, {0, 0}, march_planes<double>(deflectors, direction)).delay;
    // An angle known to (m/D)^2 comes from D away.
    EXPECT_NEAR(ours / exact, 1, 2e-4) << b;
    for (DeflectorPlane& plane : deflectors.planes) plane.deflectors.front().law = Law::Weak;
    const double weak = meet(LatLong{}, Camera{}, {0, 0}, march_planes<double>(deflectors, direction)).delay;
    EXPECT_GT(std::abs(weak / exact - 1), 0.01) << b;
  }
}

TEST(PreciseDelay, HigherOrdersAreTheIntegralOfTheLaw) {
  for (const double b : {5.1962, 5.3, 6.0, 10.0, 34.0, 35.0, 100.0, 1e4, 1e8}) {
    for (const Law law : {Law::SecondOrder, Law::Exact}) {
      // dw/db = -(alpha - 4 m/b)
      const double h = 1e-4 * (b - kCriticalRatio);
      const auto w = [&](double at) { return delay_of_higher_orders(law, 1.0, at); };
      const double slope = (8 * (w(b + h) - w(b - h)) - (w(b + 2 * h) - w(b - 2 * h))) / (12 * h);
      const double excess = entry_of(law).deflection(1.0, b).alpha - 4.0 / b;
      EXPECT_NEAR(-slope, excess, 1e-8 * excess + 1e-13 * w(b) / h) << b;
      EXPECT_NEAR(w(b * 1e9), 0.0, 15.0 / b / 1e9);
    }
  }
  EXPECT_EQ(delay_of_higher_orders(Law::Weak, 1.0, 10.0), 0.0);
  EXPECT_NEAR(delay_of_higher_orders(Law::Exact, 2.0, 2e6), 15.0 * kPi / 4.0 * 2e-6, 1e-10);
}

TEST(PreciseDelay, OfTwoImagesOfAPointOneEinsteinAngleAside) {
  // A sun at 4 kpc: 2.08045763886910174 times 4 m, 4.099e-5 s.
  const double m = 1476.625038, distance = 4.0 * 3.0856775814913673e19;
  const double angle = std::sqrt(4.0 * m / distance);
  const auto apart = [&](Law law) {
    const auto delay = [&](double image) {
      return by_planes(distance / m, direction_at(angle * image), law);
    };
    return (delay(-0.6180339887498949) - delay(1.618033988749895)) / 4.0;
  };
  EXPECT_NEAR(apart(Law::Weak), 2.08045763886910174, 1e-10);
  EXPECT_NEAR(apart(Law::Exact), 2.08045763886910174, 1e-7);  // higher orders
}

}  // namespace
}  // namespace lensplane
