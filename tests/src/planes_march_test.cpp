// SPDX-License-Identifier: Apache-2.0
//
// The method `planes` without finite distances, against rotations written down in long double.

#include "src/planes_march.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/src/deflector_scenes.h"
#include "tests/src/exact_angle.h"

namespace lensplane {
namespace {

using Vec3l = Imath::Vec3<long double>;

Vec3l wide(const Vec3& v) {
  return {v.x, v.y, v.z};
}

/// A ray's line.
struct Line {
  Vec3l point, direction;
};

/// The laws, from their formulas and from Darwin's.
long double law_by_hand(Law law, long double m, long double b) {
  const long double pi = std::acos(-1.0L);
  if (law == Law::Weak) return 4 * m / b;
  if (law == Law::SecondOrder) return 4 * m / b + 15 * pi / 4 * (m / b) * (m / b);
  return exact_reference(static_cast<double>(b / m));
}

Vec3l to_mass_across(const Line& line, const Vec3l& mass) {
  const Vec3l to_mass = mass - line.point;
  return to_mass - line.direction * to_mass.dot(line.direction);
}

/// The line after a mass: turned about it by the law's angle.
Line turned_by_hand(const Line& line, const Deflector& deflector) {
  const Vec3l mass = wide(deflector.position);
  const Vec3l across = to_mass_across(line, mass);
  const long double b = across.length();
  const Vec3l inward = across / b;
  const long double alpha = law_by_hand(deflector.law, deflector.m, b);
  const long double c = std::cos(alpha), s = std::sin(alpha);
  return {mass - (inward * c - line.direction * s) * b, line.direction * c + inward * s};
}

/// The last stretch of a path.
Line last_line(const RayPath<double>& path) {
  const RaySegment<double>& last = path.segments.back();
  return {wide(last.start), wide(last.direction)};
}

/// How far two lines are apart near `near`, across.
double apart(const Line& a, const Line& b, const Vec3l& near) {
  return static_cast<double>((to_mass_across(a, near) - to_mass_across(b, near)).length());
}

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

TEST(PlanesMarch, OneMassTurnsTheLineAboutItselfByTheLaw) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 3000; ++i) {
    const Law law = kLaws[static_cast<std::size_t>(i % 3)].law;
    const double distance = std::pow(10.0, -3 + 23 * unit(random));
    const double theta = std::pow(10.0, -5 + 5 * unit(random));  // of the mass from the ray
    const double b_over_m = kCriticalRatio * (1 + std::pow(10.0, -3 + 10 * unit(random)));
    const Vec3 direction = Vec3(0.5 * unit(random), 0.5 * unit(random), -1).normalized();
    const Vec3 aside = direction.cross(random_direction(random)).normalized();
    const Vec3 mass = (direction * std::cos(theta) + aside * std::sin(theta)) * distance;
    if (mass.z >= 0) continue;
    const double m = distance * std::sin(theta) / b_over_m;
    const Deflector deflector{m, mass, law};

    const auto path = march_planes<double>(flat_deflectors({{m, mass}}, law), direction);
    ASSERT_FALSE(path.captured);
    ASSERT_EQ(path.segments.size(), 3U);  // to the plane, round the mass, on
    const Line in{wide(Vec3(0)), wide(direction)};
    const Line expected = turned_by_hand(in, deflector);
    const Line ours = last_line(path);
    // The foot point is known to the last digits of the distance; the law enlarges that.
    const double b = distance * std::sin(theta);
    const double slope = -entry_of(law).deflection(m, b).dalpha_db;
    const double digits = 1e-15 * distance;
    const double angle = 1e-15 * (1 + path.passages[0].alpha) + slope * digits;
    EXPECT_NEAR(static_cast<double>((ours.direction - expected.direction).length()), 0, angle) << i;
    EXPECT_NEAR(apart(ours, expected, wide(mass)), 0, 3 * digits + angle * b) << i;
    EXPECT_NEAR(static_cast<double>(to_mass_across(ours, wide(mass)).length()), b, 3 * digits + angle * b);
    EXPECT_NEAR(path.passages[0].b, b, 2 * digits);
  }
}

TEST(PlanesMarch, SeveralPlanesTurnOneAfterAnother) {
  const std::vector<Lens> lenses = {{0.3, {4, 1, -50}}, {0.2, {-5, 2, -80}}, {0.25, {1, -4, -130}}};
  const Deflectors deflectors = flat_deflectors(lenses, Law::Exact);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> slope(-0.05, 0.05);
  int followed = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 direction = Vec3(slope(random), slope(random), -1).normalized();
    const auto path = march_planes<double>(deflectors, direction);
    if (path.captured || path.bends != 3) continue;
    Line line{wide(Vec3(0)), wide(direction)};
    double growth = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Deflector& deflector = deflectors.planes[k].deflectors[0];
      line = turned_by_hand(line, deflector);
      growth *= 1 - 200 * exact_law(deflector.m, path.passages[k].b).dalpha_db;
    }
    ++followed;
    const Line ours = last_line(path);
    EXPECT_NEAR(static_cast<double>((ours.direction - line.direction).length()), 0, 1e-15 * growth);
    EXPECT_NEAR(apart(ours, line, wide(Vec3(0, 0, -130))), 0, 1e-13 * growth);
  }
  EXPECT_GT(followed, 300);
}

TEST(PlanesMarch, LightThatTurnsBackMeetsTheMassesBehindTheCamera) {
  const Deflectors deflectors = flat_deflectors({{1, {0, 0, -100}}, {0.5, {4, 7, 60}}}, Law::Exact);
  const Vec3 direction = at_angle(std::asin(5.3569586 / 100));  // alpha = pi, nearly
  const auto path = march_planes<double>(deflectors, direction);
  ASSERT_EQ(path.bends, 2);
  Line line = turned_by_hand({wide(Vec3(0)), wide(direction)}, {1, {0, 0, -100}, Law::Exact});
  EXPECT_GT(line.direction.z, 0.99L);
  line = turned_by_hand(line, {0.5, {4, 7, 60}, Law::Exact});
  EXPECT_NEAR(static_cast<double>((last_line(path).direction - line.direction).length()), 0, 1e-11);
  EXPECT_NEAR(apart(last_line(path), line, wide(Vec3(4, 7, 60))), 0, 1e-9);
  EXPECT_EQ(march_planes<double>(deflectors, at_angle(0.3)).bends, 1);  // this one runs away from it
}

TEST(PlanesMarch, StretchesJoinUp) {
  const auto path = march_planes<double>(flat_deflectors({{1, {9, 0, -100}}, {1, {-9, 0, -200}}}, Law::Exact),
                                         Vec3(0.01, 0.02, -1).normalized());
  ASSERT_EQ(path.segments.size(), 5U);  // each plane adds the chord round its mass and the way on
  for (std::size_t k = 0; k + 1 < 5; ++k) {
    const RaySegment<double>& segment = path.segments[k];
    const Vec3 end = segment.start + segment.direction * segment.length;
    EXPECT_NEAR((end - path.segments[k + 1].start).length(), 0, 1e-12);
    EXPECT_GE(path.lengths[k + 1], path.lengths[k] + segment.length * (1 - 1e-12));
  }
}

TEST(PlanesMarch, MassesOnOnePlaneAddUpInAnyOrderBitForBit) {
  std::vector<Lens> lenses = {
      {1, {9, 3, -100}}, {0.7, {-8, 2, -100}}, {0.4, {1, -7, -100}}, {2, {20, 9, -100}}};
  std::mt19937 random(3);
  const Vec3 direction = Vec3(0.01, 0.02, -1).normalized();
  const auto first = march_planes<double>(flat_deflectors(lenses, Law::Exact), direction);
  EXPECT_EQ(first.bends, 1);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(lenses.begin(), lenses.end(), random);
    const auto path = march_planes<double>(flat_deflectors(lenses, Law::Exact), direction);
    EXPECT_EQ(path.segments.back().direction, first.segments.back().direction);
    EXPECT_EQ(path.segments.back().start, first.segments.back().start);
  }
}

/// The angle between what a plane with two masses does and what two planes do, `gap` apart.
double angle_of_split(double m, double gap) {
  const Vec3 direction = Vec3(0.01, 0.02, -1).normalized();
  const auto last = [&](double z) {
    const auto lenses = std::vector<Lens>{{m, {9, 3, -100}}, {0.7 * m, {-8, 2, z}}};
    return march_planes<double>(flat_deflectors(lenses, Law::Exact), direction).segments.back().direction;
  };
  return angle_between(last(-100), last(-100 - gap));
}

TEST(PlanesMarch, OnePlaneIsTheLimitOfTwoCloseOnes) {
  // To first order in the masses: what is left is of second order, the shift that each gives the other's
  // foot point, and falls by 4 when the masses are halved.
  for (const double m : {0.01, 0.001, 1e-4}) {
    EXPECT_NEAR(angle_of_split(m, 1e-9) / angle_of_split(m / 2, 1e-9), 4, 60 * m) << m;
    EXPECT_LT(angle_of_split(m, 1e-9), 0.05 * m * m);
  }
}

TEST(PlanesMarch, SourcesAtOnePointAreOneBody) {
  const Vec3 direction = at_angle(0);
  const Vec3 place(8, 3, -100);
  for (const std::size_t count : {2U, 1000U}) {
    const std::vector<Lens> many(count, {1.0 / static_cast<double>(count), place});
    const auto parts = march_planes<double>(flat_deflectors(many, Law::Exact), direction);
    const auto whole = march_planes<double>(flat_deflectors({{1, place}}, Law::Exact), direction);
    EXPECT_NEAR((parts.segments[1].direction - whole.segments[1].direction).length(), 0, 1e-15) << count;
    EXPECT_NEAR((parts.segments[1].start - whole.segments[1].start).length(), 0, 1e-13) << count;
    // It captures like one, too: each alone would let this ray pass.
    const auto inside = march_planes<double>(flat_deflectors(many, Law::Exact), at_angle(std::atan2(4, 103)));
    EXPECT_TRUE(inside.captured);
  }
}

TEST(PlanesMarch, SourcesANanometreApartDoAsOneWould) {
  const Vec3 place(8, 3, -100), beside = place + Vec3(1e-9, 0, 0);
  const auto last = [](const std::vector<Lens>& lenses) {
    return march_planes<double>(flat_deflectors(lenses, Law::Exact), at_angle(0)).segments.back().direction;
  };
  const double b = Vec3(8, 3, 0).length();
  for (const double m : {1.0, 1e-4}) {
    // Heavy ones are a body. Light ones are too far apart for that: what is missing is of second order.
    const bool body = m == 1.0;
    const double alpha = exact_law(2 * m, b).alpha;
    const double missing = body ? 0.0 : alpha - 2 * exact_law(m, b).alpha;
    EXPECT_NEAR(angle_between(last({{m, place}, {m, beside}}), last({{2 * m, place}})), missing,
                1e-9 * alpha);
  }
}

TEST(PlanesMarch, CapturesUpToTheCriticalImpactParameter) {
  for (const LawEntry& law : kLaws) {
    for (const double m : {1.0, 1e-7, 3e12}) {
      const auto captured = [&](double b) {
        const Deflectors deflectors = flat_deflectors({{m, {b, 0, -1e3 * m}}}, law.law);
        const bool plain = march_planes<double>(deflectors, Vec3(0, 0, -1)).captured;
        const DualVec3 direction = dual_vector({0, 0, -1}, {1e-3, 0, 0}, {0, 1e-3, 0});
        EXPECT_EQ(march_planes<Dual>(deflectors, direction).captured, plain);
        return plain;
      };
      EXPECT_TRUE(captured(kCriticalRatio * m * (1 - 1e-12))) << law.name;
      EXPECT_FALSE(captured(kCriticalRatio * m * (1 + 1e-12))) << law.name;
      EXPECT_TRUE(captured(0));
    }
  }
}

}  // namespace
}  // namespace lensplane
