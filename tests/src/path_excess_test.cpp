// SPDX-License-Identifier: Apache-2.0

#include "src/path_excess.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <random>
#include <vector>

namespace lensplane {
namespace {

using Precise = boost::multiprecision::cpp_bin_float_100;

struct PreciseVector {
  Precise x, y;
};

/// The same path twice: as sums of small terms, and in a hundred digits. It lies in a plane; its arcs are
/// those of circles.
struct TwoPaths {
  PathExcess ours;
  Precise length = 0, angle = 0;  // the present direction's, from z to x
  PreciseVector end{0, 0};

  PreciseVector direction() const { return {sin(angle), cos(angle)}; }
  void go(double way) {
    ours.go(way);
    const PreciseVector d = direction();
    length += way, end.x += way * d.x, end.y += way * d.y;
  }
  void turn(double radius, double by) {
    const PreciseVector before = direction(),
                        chord_of = {sin(angle + by / Precise(2)), cos(angle + by / Precise(2))};
    angle += by;
    const PreciseVector after = direction();
    const Precise chord = 2 * radius * abs(sin(Precise(by) / 2)), arc = radius * abs(Precise(by));
    const PreciseVector detour{chord * chord_of.x, chord * chord_of.y};
    const auto vector = [](const Precise& x, const Precise& z) {
      return Vec3(static_cast<double>(x), 0, static_cast<double>(z));
    };
    ours.go_round({vector(after.x - before.x, after.y - before.y), static_cast<double>(arc),
                   vector(detour.x, detour.y),
                   static_cast<double>(arc - (detour.x * after.x + detour.y * after.y))});
    length += arc, end.x += detour.x, end.y += detour.y;
  }
};

TEST(PathExcess, IsRightToItsLastDigitsForAnyAngle) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double size : {1.0, 1e-3, 1e-6, 1e-9, 1e-12}) {
    for (int n = 0; n < 50; ++n) {
      TwoPaths paths;
      const int bends = 1 + n % 5;
      paths.go(1e20 * (2 + uniform(random)));
      for (int i = 0; i < bends; ++i) {
        paths.turn(1e20 * size * size * (2 + uniform(random)), size * uniform(random));
        if (i + 1 < bends) paths.go(1e20 * (2 + uniform(random)));
      }
      const PreciseVector d = paths.direction();
      const Precise front = paths.length - (paths.end.x * d.x + paths.end.y * d.y);
      // Turns to and fro may cancel one another.
      const double all = 1e20 * size * size;
      EXPECT_NEAR(excess_over_wave_front(paths.ours), static_cast<double>(front), 1e-14 * all * bends)
          << size;

      const double way = 1e20 * (2 + uniform(random)), aside = 1e19 * size * size * uniform(random);
      const PreciseVector end{paths.end.x + way * d.x + aside * d.y, paths.end.y + way * d.y - aside * d.x};
      const Precise line = paths.length + way - sqrt(end.x * end.x + end.y * end.y);
      const Vec3 beside(aside * static_cast<double>(d.y), 0, -aside * static_cast<double>(d.x));
      EXPECT_NEAR(excess_over_straight_line(paths.ours, way, beside), static_cast<double>(line),
                  1e-13 * all * bends)
          << size;
    }
  }
}

TEST(PathExcess, OfAStraightPathIsNothing) {
  PathExcess path;
  EXPECT_EQ(excess_over_straight_line(path, 0.0, Vec3(0)), 0.0);
  path.go(3e20);
  EXPECT_EQ(excess_over_wave_front(path), 0.0);
  EXPECT_EQ(excess_over_straight_line(path, 7e19, Vec3(0)), 0.0);
}

}  // namespace
}  // namespace lensplane
