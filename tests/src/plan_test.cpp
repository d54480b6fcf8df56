// SPDX-License-Identifier: Apache-2.0

#include "src/plan.h"

#include <gtest/gtest.h>

namespace lensplane {
namespace {

TEST(Plan, SharesAreThoseOfTheTilesThatTheFilmCovers) {
  Camera camera;
  camera.width = 96;
  camera.height = 32;
  camera.overscan = 2;
  Plan plan;
  EXPECT_TRUE(recipe_shares(plan, camera).empty());
  plan.recipes.resize(3);
  EXPECT_EQ(recipe_shares(plan, camera), (std::vector<double>{0, 0, 1}));
  plan.tiles = {64, 2, 1, {1, 0}};
  EXPECT_EQ(recipe_shares(plan, camera), (std::vector<double>{0.36, 0.64, 0}));
}

TEST(Plan, MethodsHaveTheirNames) {
  for (const MethodName& entry : kMethodNames) {
    EXPECT_EQ(method_named(entry.name), entry.method);
    EXPECT_EQ(name_of(entry.method), entry.name);
  }
  EXPECT_FALSE(method_named("newton"));
}

}  // namespace
}  // namespace lensplane
