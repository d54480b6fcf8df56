// SPDX-License-Identifier: Apache-2.0

#include "src/direction_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace lensplane {
namespace {

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

std::vector<std::size_t> by_brute_force(const std::vector<Vec3>& directions, const SkyPatch& patch) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (patch.contains(directions[i])) found.push_back(i);
  }
  return found;
}

TEST(DirectionIndex, FindsWhatIsNear) {
  std::mt19937 random(1);
  std::vector<Vec3> sky, field;
  for (int i = 0; i < 2000; ++i) {
    sky.push_back(random_direction(random));
    field.push_back((Vec3(0, 1, 0) + 1e-3 * random_direction(random)).normalized());  // round a pole
  }
  for (const std::vector<Vec3>& directions : {sky, field}) {
    const DirectionIndex index(directions);
    for (int i = 0; i < 100; ++i) {
      const Vec3 centre = i % 2 ? directions[static_cast<std::size_t>(i)] : random_direction(random);
      for (const double chord : {0.0, 1e-4, 1e-3, 0.1, 1.0, 2.0}) {
        const Vec3 across = centre.cross(random_direction(random)).normalized();
        for (const SkyPatch& patch :
             {SkyPatch{centre, chord}, SkyPatch{centre, chord, across, 0.1 * chord}}) {
          std::vector<std::size_t> found = index.within(patch);
          std::sort(found.begin(), found.end());
          EXPECT_EQ(found, by_brute_force(directions, patch));
        }
      }
    }
  }
}

TEST(DirectionIndex, PatchesAreBandsAlongGreatCircles) {
  const SkyPatch patch{Vec3(0, 0, -1), 1.5, Vec3(0, 1, 0), 0.1};
  const auto at = [](double longitude, double latitude) {
    return Vec3(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                -std::cos(longitude) * std::cos(latitude));
  };
  EXPECT_TRUE(patch.contains(at(1.6, 0.09)));
  EXPECT_FALSE(patch.contains(at(1.6, 0.11)));
  EXPECT_FALSE(patch.contains(at(0, -0.11)));
  EXPECT_FALSE(patch.contains(at(1.75, 0)));
}

TEST(DirectionIndex, HoldsNoneAndManyInOnePlace) {
  EXPECT_TRUE(DirectionIndex({}).within({Vec3(0, 0, -1), 2}).empty());
  const DirectionIndex index(std::vector<Vec3>(100, Vec3(0, 0, -1)));
  EXPECT_EQ(index.within({Vec3(0, 0, -1), 0}).size(), 100U);
  EXPECT_TRUE(index.within({Vec3(0, 1, 0), 1}).empty());
}

}  // namespace
}  // namespace lensplane
