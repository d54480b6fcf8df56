// SPDX-License-Identifier: Apache-2.0

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "pipeline/cli/plan_json.h"
#include "pipeline/cli/plan_text.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A shot of `count` lenses, named a0, a1, ..., and a plan that culls every other one. Of the film's two
/// tiles the left one, 64 of 100 pixels wide, is traced by the first recipe.
std::pair<Shot, PlannedFrame> example(std::size_t count) {
  Shot shot;
  shot.name = "example";
  PlannedFrame planned{1001, {}, {}, {}};
  planned.scene.camera.width = 100;
  planned.scene.camera.height = 50;
  Plan& plan = planned.plan;
  plan.bound_px = 0.125;
  for (std::size_t i = 0; i < count; ++i) {
    shot.lenses.push_back({"a" + std::to_string(i), {}, {}});
    planned.scene.lenses.push_back({1476.625, {0, 0, -1e3}});
    const bool culled = i % 2 == 1;
    plan.lenses.push_back({i, culled, Law::SecondOrder, culled ? 0.25 : 2.0 + static_cast<double>(i), 0.0625,
                           culled ? "too far" : "near"});
  }
  plan.lenses[0].moves_px = std::numeric_limits<double>::infinity();
  plan.choices = {{"finite distance", false, 0.03, "small", 0.36},
                  {"jacobian", true, 0, "asked for", 1},
                  {"delay", false, 0, "no output asks for it", 0}};
  plan.near_masses = 0.36;
  const Deflector weak{1476.625, {0, 0, -1e3}, Law::Weak, 0, 1};
  const Deflector exact{1476.625, {0, 0, -1e3}, Law::Exact, 2, 1};
  plan.recipes.resize(2);
  plan.recipes[0].planes = {{{0, 0, 0}, {weak}}};
  plan.recipes[1].planes = {{{0, 0, 0}, {weak, exact}}};
  plan.recipes[1].finite_distance = true;
  plan.tiles = {64, 2, 1, {0, 1}};
  return {shot, planned};
}

TEST(PlanText, SaysWhatBecomesOfEveryLensEffectAndTile) {
  const auto [shot, planned] = example(3);
  EXPECT_EQ(text_from_plan(shot, planned),
            "shot example, frame 1001: method planes, tolerance 0.05 px, left out at most 0.125 px\n"
            "(how far aside pixels look; where light is stretched, points lie farther off on the film)\n"
            "\n"
            "  lens  mass    distance  law           moves at most  left out at most  why\n"
            "  a0    1 Msun  1 km      second-order  no limit       0.0625 px         near\n"
            "  a1    1 Msun  1 km      culled        0.25 px        0.0625 px         too far\n"
            "  a2    1 Msun  1 km      second-order  4 px           0.0625 px         near\n"
            "\n"
            "  effect                        left out at most  why\n"
            "  finite distance  near masses  0.03 px           small\n"
            "  jacobian         on           -                 asked for\n"
            "  delay            off          -                 no output asks for it\n"
            "\n"
            "  share of the film  finite distance  lenses by their laws\n"
            "  64.0 %             off              weak 1\n"
            "  36.0 %             on               weak 1, exact 1\n");
}

TEST(PlanText, RecipesThatReadTheSameShareARow) {
  auto [shot, planned] = example(3);
  planned.plan.recipes[1] = planned.plan.recipes[0];
  EXPECT_THAT(text_from_plan(shot, planned),
              HasSubstr("laws\n  100.0 %            off              weak 1\n"));
}

TEST(PlanText, OfManyLensesThoseThatMoveMostAreListed) {
  const auto [shot, planned] = example(41);
  const std::string text = text_from_plan(shot, planned);
  EXPECT_THAT(text, HasSubstr("  a40   1 Msun"));
  EXPECT_THAT(text, HasSubstr("  a0    1 Msun"));
  EXPECT_THAT(text, Not(HasSubstr("  a1    1 Msun")));
  EXPECT_THAT(text, HasSubstr("\n  and 21 more: culled 20, second-order 1; each moves at most 4 px, left out "
                              "together at most 1.31 px\n"));
}

TEST(PlanText, OtherMethodsBendByAllLenses) {
  auto [shot, planned] = example(2);
  planned.plan = {};
  planned.plan.method = Method::Kishi;
  EXPECT_EQ(
      text_from_plan(shot, planned),
      "shot example, frame 1001: method kishi\n"
      "\n"
      "  lens  mass    distance  law   moves at most  left out at most  why\n"
      "  a0    1 Msun  1 km      weak  -              -                 the method leaves no lens out\n"
      "  a1    1 Msun  1 km      weak  -              -                 the method leaves no lens out\n");
}

TEST(PlanJson, HoldsEverythingAndNullForWhatHasNoLimit) {
  const auto [shot, planned] = example(3);
  const auto json = nlohmann::json::parse(json_from_plans(shot, {planned, planned}));
  EXPECT_EQ(json["shot"], "example");
  ASSERT_EQ(json["frames"].size(), 2U);
  const auto& frame = json["frames"][1];
  EXPECT_EQ(frame["frame"], 1001);
  EXPECT_EQ(frame["method"], "planes");
  EXPECT_EQ(frame["law"], "auto");
  EXPECT_EQ(frame["tolerance_px"], 0.05);
  EXPECT_EQ(frame["bound_px"], 0.125);
  ASSERT_EQ(frame["lenses"].size(), 3U);
  EXPECT_TRUE(frame["lenses"][0]["moves_px"].is_null());
  EXPECT_EQ(frame["lenses"][0]["law"], "second-order");
  EXPECT_TRUE(frame["lenses"][1]["law"].is_null());
  EXPECT_EQ(frame["lenses"][1]["culled"], true);
  EXPECT_EQ(frame["lenses"][1]["m"], 1476.625);
  EXPECT_EQ(frame["lenses"][1]["distance"], 1000);
  EXPECT_EQ(frame["lenses"][2]["reason"], "near");
  EXPECT_EQ(frame["effects"][0]["name"], "finite distance");
  EXPECT_EQ(frame["effects"][0]["bound_px"], 0.03);
  EXPECT_EQ(frame["effects"][0]["share"], 0.36);
  EXPECT_EQ(frame["effects"][1]["on"], true);
  EXPECT_EQ(frame["near_masses"], 0.36);
  EXPECT_DOUBLE_EQ(frame["recipes"][0]["share"].get<double>(), 0.64);
  EXPECT_EQ(frame["recipes"][1]["deflectors"][1]["lens"], "a2");
  EXPECT_EQ(frame["recipes"][1]["deflectors"][1]["law"], "exact");
  EXPECT_EQ(frame["tiles"]["level"], nlohmann::json({0, 1}));
}

}  // namespace
}  // namespace lensplane
