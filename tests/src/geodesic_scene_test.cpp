// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/src/schwarzschild.h"

namespace lensplane {
namespace {

TEST(GeodesicScene, SeveralThinMassesAddUp) {
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

TEST(GeodesicScene, LightRunsBackTheWayItCame) {
  const auto masses = three_masses();
  const std::array far = {Ball{Vec3(0, 0, -1000), 700}};
  const std::array home = {Ball{Vec3(0), 1e-3}};
  for (const Vec3& d : {Vec3(0, 0, -1), Vec3(0.3, 0, -1), Vec3(-0.1, 0.2, -1), Vec3(0.02, 0.05, -1)}) {
    const auto there = trace(masses, d.normalized(), kFine, far).hits[0];
    ASSERT_TRUE(there.hit);
    const auto back = trace_geodesic<double>(masses, there.point, -there.direction, kFine, {home}).hits[0];
    ASSERT_TRUE(back.hit);
    EXPECT_NEAR(back.point.cross(back.direction).length(), 0, 1e-10);  // passes the camera
    EXPECT_NEAR((back.direction + d.normalized()).length(), 0, 1e-6);  // bends on over the last millimetre
    EXPECT_NEAR(back.length + 1e-3, there.length, 1e-9);
  }
}

TEST(GeodesicScene, TurnsWithTheScene) {
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

TEST(GeodesicScene, DoesNotCareAboutTheUnitOfLength) {
  auto masses = three_masses();
  const Vec3 d = Vec3(0.05, 0.02, -1).normalized();
  const auto ray = trace(masses, d, 1e-12);
  for (const double scale : {0x1p-60, 0x1p80}) {
    auto scaled = masses;
    for (PointMass& mass : scaled) mass.m *= scale, mass.position *= scale;
    EXPECT_EQ(trace(scaled, d, 1e-12).direction, ray.direction);
  }
}

TEST(GeodesicScene, WithoutMassIsStraightBitForBit) {
  const Vec3 start(0.3, -7.0, 11.0), d = Vec3(0.1, 0.7, -0.3).normalized();
  const std::array none = {PointMass{0, start}, PointMass{0, start + d}};
  const std::array ball = {Ball{start + d * 10.0, 2.0}, Ball{start, 1.0}, Ball{start - d * 10.0, 2.0}};
  for (const std::span<const PointMass> masses :
       {std::span<const PointMass>(), std::span<const PointMass>(none)}) {
    const auto ray = trace_geodesic<double>(masses, start, d, 1e-9, {ball});
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

TEST(GeodesicScene, MassesOfZeroChangeNothing) {
  auto masses = three_masses();
  const Vec3 d = Vec3(0.05, 0.02, -1).normalized();
  const auto ray = trace(masses, d, 1e-9);
  masses.insert(masses.begin() + 1, {0.0, Vec3(0)});
  EXPECT_EQ(trace(masses, d, 1e-9).direction, ray.direction);
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
  for (const BodyHit<N>& hit : ray.hits) {
    result = result && finite(hit.point) && finite(Vector<N>(hit.length, hit.delay, N(0.0)));
  }
  return result;
}

TEST(GeodesicScene, IsFiniteWhateverTheStart) {
  const std::array scales = {0.0, 1e-300, 1e-160, 1e-20, 0.5, 1.0, 3.0, 1e10, 1e25, 1e160, 1e300};
  for (const double x : scales) {
    for (const double z : scales) {
      for (const double m : {1e-300, 1.0, 1e20}) {
        const std::array masses = {PointMass{m, Vec3(x, 0, -z)}, PointMass{1.0, Vec3(-4, 1, -7)}};
        const std::array balls = {Ball{Vec3(0, 0, -10), 3}, Ball{Vec3(x, 0, -z), 1}};
        EXPECT_TRUE(all_finite(trace(masses, Vec3(0, 0, -1), 1e-6, balls))) << x << ' ' << z << ' ' << m;
        const DualVec3 d = dual_vector(Vec3(0, 0, -1), Vec3(1e-3, 0, 0), Vec3(0, 1e-3, 0));
        EXPECT_TRUE(all_finite(trace_geodesic<Dual>(masses, DualVec3(Dual(0.0)), d, 1e-6, {balls})))
            << x << ' ' << z << ' ' << m;
      }
    }
  }
}

}  // namespace
}  // namespace lensplane
