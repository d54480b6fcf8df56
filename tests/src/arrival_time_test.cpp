// SPDX-License-Identifier: Apache-2.0
//
// Arrival times by the method `planes` against those of curved rays, and the logarithm of Shapiro's delay.

#include "src/arrival_time.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/geodesic.h"
#include "src/planes_march.h"
#include "src/surfaces.h"
#include "tests/src/deflector_scenes.h"

namespace lensplane {
namespace {

const std::vector<Lens> kOneMass = {{1, {0, 0, -1}}};
const std::vector<Lens> kMasses = {
    {1, {0.1, 0.2, -1}}, {2, {-0.3, 0.5, -2}}, {0.5, {1, 0.5, 0.1}}, {1, {0.2, 0.2, 1.5}}};
constexpr double kAngles[] = {0.05, 0.3, 1.0, 1.5, 1.7, 2.5, 3.1};

std::vector<Lens> times(std::vector<Lens> lenses, double k) {
  for (Lens& lens : lenses) lens.m *= k;
  return lenses;
}

/// By how much the delays by `planes` and by curved rays differ, for light from infinity.
double apart(const std::vector<Lens>& lenses, double angle) {
  std::vector<PointMass> masses;
  for (const Lens& lens : lenses) masses.push_back({lens.m, lens.position});
  const double curved = trace_geodesic<double>(masses, Vec3(0), at_angle(angle), 1e-16).delay;
  const auto path = march_planes<double>(round_deflectors(lenses, Law::Exact), at_angle(angle));
  return meet(LatLong{}, Camera{}, {0, 0}, path).delay - curved;
}

TEST(ArrivalTime, OfOneMassIsThatOfCurvedRaysToFirstOrder) {
  for (const double angle : kAngles) {
    std::printf("%g: %g %g %g\n", angle, apart(times(kOneMass, 1e-3), angle) / 1e-6,
                apart(times(kOneMass, 1e-4), angle) / 1e-8, apart(times(kOneMass, 1e-5), angle) / 1e-10);
    std::printf("  %g: %g %g %g\n", angle, apart(times(kMasses, 1e-3), angle) / 1e-6,
                apart(times(kMasses, 1e-4), angle) / 1e-8, apart(times(kMasses, 1e-5), angle) / 1e-10);
  }
}

double apart_on_ball(const std::vector<Lens>& lenses, const Vec3& centre, double radius, Vec3 direction) {
  direction.normalize();
  std::vector<PointMass> masses;
  for (const Lens& lens : lenses) masses.push_back({lens.m, lens.position});
  const Ball ball{centre, radius};
  const auto curved = trace_geodesic<double>(masses, Vec3(0), direction, 1e-16, {&ball, 1}).hits[0];
  const Deflectors d = round_deflectors(lenses, Law::Exact);
  const auto ours =
      meet(Sphere{centre, radius, {}}, Camera{}, {0, 0}, march_planes<double>(d, direction), &d);
  EXPECT_TRUE(curved.hit);
  EXPECT_EQ(ours.outcome, Outcome::Hit);
  const Vec3 n = curved.point - centre;
  auto st = st_from_sphere_normal(n);
  std::printf("   st %g %g dist %g delay %g\n", ours.st.s - st.s, ours.st.t - st.t,
              ours.distance - curved.length, ours.delay - curved.delay);
  return ours.delay - curved.delay;
}
TEST(ArrivalTime, Ball) {
  for (double m : {1e-3, 1e-4, 1e-5}) {
    std::printf("m %g\n", m);
    apart_on_ball(times(kOneMass, m), {0.2, 0.3, -3}, 1, {0.1, 0.1, -1});
    apart_on_ball(times(kOneMass, m), {0.2, 0.3, -1}, 0.5, {0.2, 0.3, -1});
    apart_on_ball(times(kOneMass, m), {0.2, 0.3, -0.6}, 0.2, {0.2, 0.3, -0.6});
    apart_on_ball(times(kOneMass, m), {0.2, 0.3, 4}, 0.2, {0.2, 0.3, 4});
    apart_on_ball(times(kMasses, m), {0.2, 0.0, -4}, 1, {0.2, 0.0, -4});
    apart_on_ball(times(kMasses, m), {0.2, 1.0, -1.7}, 0.2, {0.2, 1.0, -1.7});
    apart_on_ball(times(kMasses, m), {3, 0.0, 2}, 1, {3, 0.1, 2});
  }
}

}  // namespace
}  // namespace lensplane
