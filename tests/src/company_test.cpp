// SPDX-License-Identifier: Apache-2.0

#include "src/company.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "src/geodesic.h"
#include "src/planes_march.h"
#include "tests/src/deflector_scenes.h"

namespace lensplane {
namespace {

/// Two masses a metre apart, a kilometre away, and a ray past them.
struct Pair {
  std::array<Lens, 2> lenses;
  Vec3 direction;
};

constexpr double kDistance = 1e3;

class RandomPairs {
 public:
  explicit RandomPairs(unsigned seed) : random_(seed) {}

  /// Masses of about `m`; the ray passes neither nearer than `least` nor farther than `most` from the middle.
  Pair next(double m, double least, double most) {
    const Vec3 apart = Vec3(normal_(random_), normal_(random_), normal_(random_)).normalized();
    const Vec3 middle(0, 0, -kDistance);
    const Vec3 first = middle - apart * 0.5, second = middle + apart * 0.5;
    const double share = uniform(0.2, 0.8);
    for (;;) {
      const Vec3 aim(uniform(-most, most), uniform(-most, most), -kDistance);
      const Vec3 direction = aim.normalized();
      if (first.cross(direction).length() < least || second.cross(direction).length() < least) continue;
      return {{Lens{2 * share * m, first}, Lens{2 * (1 - share) * m, second}}, direction};
    }
  }

 private:
  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

Vec3 curved(const std::vector<Lens>& lenses, const Vec3& direction) {
  std::vector<PointMass> masses;
  for (const Lens& lens : lenses) masses.push_back({lens.m, lens.position});
  return trace_geodesic<double>(masses, Vec3(0), direction, 1e-14).direction;
}

Vec3 by_planes(const Deflectors& deflectors, const Vec3& direction) {
  return march_planes(deflectors, direction).segments.back().direction;
}

/// What two masses do together: less what each does alone.
template <class Trace>
Vec3 joint(const Pair& pair, Trace trace) {
  const auto [first, second] = pair.lenses;
  return trace({first, second}) - trace({first}) - trace({second}) + pair.direction;
}

/// Angles by which the planes' joint effect is off.
struct Gap {
  double alone, in_company;  // without company, and with it
  double terms;              // what company adds to the bends, each term's size for itself
};

double size_of_terms(const Pair& pair, const Deflectors& deflectors) {
  double sum = 0.0;
  for (const DeflectorPlane& plane : deflectors.planes) {
    for (const Deflector& d : plane.deflectors) {
      const double b = pair.lenses[d.lens].position.cross(pair.direction).length();
      sum += company_bend(d.m, d.company, b);
    }
  }
  return sum;
}

Gap gap_of(const Pair& pair, Projection projection) {
  const auto plain = [&](const std::vector<Lens>& lenses) {
    return deflectors_of(scene_of(projection, lenses), Law::Exact, true);
  };
  const Vec3 truth = joint(pair, [&](const std::vector<Lens>& l) { return curved(l, pair.direction); });
  const Vec3 alone =
      joint(pair, [&](const std::vector<Lens>& l) { return by_planes(plain(l), pair.direction); });
  const Vec3 together = joint(
      pair, [&](const std::vector<Lens>& l) { return by_planes(in_company(plain(l)), pair.direction); });
  return {(alone - truth).length(), (together - truth).length(),
          size_of_terms(pair, in_company(plain({pair.lenses[0], pair.lenses[1]})))};
}

/// Nearer to a mass than their distance from one another, at it, and beyond it.
constexpr std::array<std::pair<double, double>, 3> kReaches = {{{0.05, 0.3}, {0.3, 1.5}, {2, 10}}};

TEST(Company, CarriesMostOfWhatTwoMassesDoTogether) {
  RandomPairs pairs(3);
  for (const Projection projection : {Projection::Perspective, Projection::LatLong}) {
    for (const double m : {1e-5, 1e-4, 1e-3}) {
      for (const auto& [least, most] : kReaches) {
        double alone = 0.0, in_company = 0.0;
        for (int n = 0; n < 100; ++n) {
          const Gap gap = gap_of(pairs.next(m, least, most), projection);
          EXPECT_LE(gap.alone, kCompanySize * gap.terms);
          EXPECT_LE(gap.in_company, kCompanyError * gap.terms);
          alone += gap.alone;
          in_company += gap.in_company;
        }
        EXPECT_LT(in_company, 0.25 * alone) << m << " " << least;
      }
    }
  }
}

/// The cross term of the second order, and that the sum is not counted twice.
TEST(Company, FromAfarTwoMassesAreOne) {
  const double m = 1e-4, s = 1e-3;
  for (const double b : {1.0, 3.0}) {
    const std::vector<Lens> pair = {{m, Vec3(-s / 2, 0, -kDistance)}, {m, Vec3(s / 2, 0, -kDistance)}};
    const Vec3 direction = Vec3(0, b, -kDistance).normalized();
    const Deflectors two = in_company(flat_deflectors(pair, Law::Exact));
    const Deflectors one = flat_deflectors({{2 * m, Vec3(0, 0, -kDistance)}}, Law::Exact);
    const Vec3 apart = by_planes(flat_deflectors(pair, Law::Exact), direction) - by_planes(one, direction);
    const Vec3 together = by_planes(two, direction) - by_planes(one, direction);
    EXPECT_LT(together.length(), 0.03 * apart.length()) << b;
  }
}

TEST(Company, AMassAloneStaysAsItIs) {
  const Deflectors one = flat_deflectors({{1.0, Vec3(3, 4, -100)}}, Law::Exact, true);
  const Deflector d = in_company(one).planes[0].deflectors[0];
  EXPECT_EQ(d.position, one.planes[0].deflectors[0].position);
  EXPECT_EQ(d.company, Company{});
}

TEST(Company, DoesNotDependOnTheOrderOfTheLenses) {
  std::vector<Lens> lenses = {{1.0, Vec3(3, 4, -100)}, {2.0, Vec3(-3, 1, -150)}, {0.5, Vec3(9, 0, -100)}};
  const Vec3 direction = Vec3(0.05, 0.01, -1).normalized();
  const Vec3 there = by_planes(in_company(flat_deflectors(lenses, Law::Exact, true)), direction);
  std::reverse(lenses.begin(), lenses.end());
  EXPECT_EQ(by_planes(in_company(flat_deflectors(lenses, Law::Exact, true)), direction), there);
}

/// Weaker laws leave it out.
TEST(Company, BelongsToTheExactLaw) {
  const std::vector<Lens> lenses = {{1e-3, Vec3(-0.5, 0, -kDistance)}, {1e-3, Vec3(0.5, 0, -kDistance)}};
  for (const Law law : {Law::Weak, Law::SecondOrder}) {
    const Deflectors deflectors = in_company(flat_deflectors(lenses, law));
    const Deflector& d = deflectors.planes[0].deflectors[0];
    EXPECT_GT(d.company.weight, 0.0);
    EXPECT_EQ(bend_by<double>(d, 0.1, std::nullopt)->alpha, entry_of(law).deflection(d.m, 0.1).alpha);
  }
}

}  // namespace
}  // namespace lensplane
