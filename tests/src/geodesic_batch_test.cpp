// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic_batch.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/src/schwarzschild.h"

namespace lensplane {
namespace {

/// More rays than lanes, of all kinds: captured, winding, hardly bent.
template <class N>
std::vector<Vector<N>> directions(int count) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vector<N>> result;
  for (int i = 0; i < count; ++i) {
    const Vec3 d = Vec3(0.2 * normal(random), 0.2 * normal(random), -1).normalized();
    const DualVec3 dual = dual_vector(d, Vec3(1e-3, 0, 0), Vec3(0, -1e-3, 0));
    if constexpr (std::is_same_v<N, Dual>) result.push_back(dual);
    if constexpr (!std::is_same_v<N, Dual>) result.push_back(d);
  }
  return result;
}

std::array<double, 3> parts(const Dual& a) {
  return {a.v, a.dx, a.dy};
}
std::array<double, 3> parts(double a) {
  return {a, 0.0, 0.0};
}

template <class N>
void expect_same(const Vector<N>& a, const Vector<N>& b) {
  EXPECT_EQ(parts(a.x), parts(b.x));
  EXPECT_EQ(parts(a.y), parts(b.y));
  EXPECT_EQ(parts(a.z), parts(b.z));
}

template <class N>
void expect_batch_is_ray_by_ray(const std::vector<PointMass>& masses) {
  const std::array balls = {Ball{Vec3(-20, 5, -300), 120}, Ball{masses[0].position, 4}};
  const Vector<N> start(N(0.0));
  const auto all = directions<N>(300);
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, all.size()}) {
    const std::span some(all.data(), count);
    const auto rays = trace_geodesics<N>(masses, start, some, 1e-9, {balls});
    ASSERT_EQ(rays.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto alone = trace_geodesic<N>(masses, start, some[i], 1e-9, {balls});
      EXPECT_EQ(rays[i].captured, alone.captured);
      expect_same(rays[i].direction, alone.direction);
      expect_same(rays[i].position, alone.position);
      EXPECT_EQ(parts(rays[i].delay), parts(alone.delay));
      ASSERT_EQ(rays[i].hits.size(), 2U);
      for (int k = 0; k < 2; ++k) {
        EXPECT_EQ(rays[i].hits[k].hit, alone.hits[k].hit);
        expect_same(rays[i].hits[k].point, alone.hits[k].point);
        EXPECT_EQ(parts(rays[i].hits[k].delay), parts(alone.hits[k].delay));
        EXPECT_EQ(parts(rays[i].hits[k].length), parts(alone.hits[k].length));
      }
    }
  }
}

TEST(GeodesicBatch, IsRayByRayBitForBit) {
  auto masses = three_masses();
  expect_batch_is_ray_by_ray<double>(masses);
  expect_batch_is_ray_by_ray<Dual>(masses);
  for (PointMass& mass : masses) mass.m *= 10.0;  // captures some
  expect_batch_is_ray_by_ray<double>(masses);
  expect_batch_is_ray_by_ray<Dual>(masses);
}

TEST(GeodesicBatch, LeavesMassesOfZeroOut) {
  auto masses = three_masses();
  masses[1].m = 0.0;
  expect_batch_is_ray_by_ray<double>(masses);
  masses[0].m = masses[2].m = 0.0;
  expect_batch_is_ray_by_ray<double>(masses);
}

}  // namespace
}  // namespace lensplane
