// SPDX-License-Identifier: Apache-2.0

#include "src/finite_shift_batch.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <type_traits>

#include "src/bodies.h"

namespace lensplane {
namespace {

/// Masses before and behind, two of them on one plane.
Deflectors some_masses() {
  Deflectors masses;
  masses.finite_distance = true;
  masses.outward = 3;
  for (const double z : {-1.0, -2.5, -7.0}) {
    DeflectorPlane plane;
    plane.centre = {0.1, 0, z};
    for (const double x : {0.1, -0.4}) {
      plane.deflectors.push_back({1e-3, {x, 0.2, z}, Law::Exact});
    }
    masses.planes.push_back(plane);
  }
  return masses;
}

template <class Number>
Number number(double value, std::mt19937& random) {
  std::uniform_real_distribution<double> slope(-1, 1);
  if constexpr (std::is_same_v<Number, Dual>) {
    return {value, slope(random), slope(random)};
  } else {
    return value;
  }
}

void expect_same(double a, double b) {
  EXPECT_EQ(a, b);
}
void expect_same(const Dual& a, const Dual& b) {
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.dx, b.dx);
  EXPECT_EQ(a.dy, b.dy);
}

template <class Number>
void compare(const Sphere& sphere, int bends, unsigned seed) {
  SCOPED_TRACE(testing::Message() << "bends " << bends << " seed " << seed);
  const Deflectors masses = some_masses();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> aside(-0.5, 0.5), far(0, 12);
  VectorLane<Number> start, direction;
  Ends ends;
  for (int i = 0; i < kBatchSize; ++i) {
    const Vec3 s(aside(random), aside(random), -0.2 * far(random));
    const Vec3 d = Vec3(aside(random), aside(random), i % 5 == 0 ? 1 : -1).normalized();
    start.set(i, {number<Number>(s.x, random), number<Number>(s.y, random), number<Number>(s.z, random)});
    direction.set(i, {number<Number>(d.x, random), number<Number>(d.y, random), number<Number>(d.z, random)});
    ends.at[i] = i % 7 == 0 ? std::numeric_limits<double>::infinity() : far(random);
  }
  // Just through a mass, and from where it stands.
  start.set(3, constant<Number>(Vec3(0.1, 0.2, 0)));
  direction.set(3, constant<Number>(Vec3(0, 0, -1)));
  start.set(4, constant<Number>(Vec3(0.1, 0.2, -1)));
  VectorLane<Number> shifted_start = start, shifted_direction = direction;
  shift_to_ball(masses, sphere, ends, bends, shifted_start, shifted_direction);
  for (int i = 0; i < kBatchSize; ++i) {
    SCOPED_TRACE(i);
    const auto one = shifted_to_ball(
        masses, RaySegment<Number>{start.get(i), direction.get(i), Number(ends.at[i]), bends}, sphere);
    const auto s = shifted_start.get(i), d = shifted_direction.get(i);
    for (int c = 0; c < 3; ++c) {
      expect_same(s[c], one.start[c]);
      expect_same(d[c], one.direction[c]);
    }
  }
}

TEST(FiniteShiftBatch, IsRayByRayBitForBit) {
  for (const Sphere& sphere :
       {Sphere{{0.2, 0, -5}, 1, {}}, Sphere{{0, 0, -1}, 0.6, {}}, Sphere{{3, 0, 2}, 1, {}}}) {
    for (const int bends : {0, 1, 2, 3}) {
      for (const unsigned seed : {1u, 2u, 3u}) {
        compare<double>(sphere, bends, seed);
        compare<Dual>(sphere, bends, seed);
      }
    }
  }
}

TEST(FiniteShiftBatch, ShiftsMoreThanRounding) {
  const Deflectors masses = some_masses();
  VectorLane<double> start{}, direction{};
  Ends ends;
  for (int i = 0; i < kBatchSize; ++i) {
    start.set(i, {0.01 * i, 0, -3});
    direction.set(i, {0, 0, -1});
    ends.at[i] = std::numeric_limits<double>::infinity();
  }
  const VectorLane<double> before = direction;
  shift_to_ball(masses, Sphere{{0.3, 0, -8}, 1, {}}, ends, 2, start, direction);
  for (int i = 0; i < kBatchSize; ++i) {
    EXPECT_GT((direction.get(i) - before.get(i)).length(), 1e-5);
  }
}

}  // namespace
}  // namespace lensplane
