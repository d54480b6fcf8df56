// SPDX-License-Identifier: Apache-2.0

#include "src/plan_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/src/scenes.h"

namespace lensplane {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(PlanWords, SayInOneLineWhatIsSimulated) {
  const Scene scene = seed_fig6(100);
  EXPECT_EQ(describe(plan_trace(scene, Method::ShinotsukaMakino)),
            "shinotsuka-makino: weak law, 3 sources on 3 planes");
  EXPECT_EQ(describe(plan_trace(scene, Method::Kishi)), "kishi: weak law, 3 sources on 1 plane");
  EXPECT_THAT(describe(plan_trace(scene, Method::Geodesic)),
              HasSubstr("geodesic: 3 lenses, curved rays to "));
}

TEST(PlanWords, HaveALineForAPlanOfNothing) {
  EXPECT_EQ(describe(Plan{}), "planes: 0 lenses; within 0 px");
  for (const MethodName& entry : kMethodNames) {
    Plan plan;
    plan.method = entry.method;
    EXPECT_THAT(describe(plan), HasSubstr(std::string(entry.name) + ": ")) << entry.name;
  }
}

TEST(PlanWords, NumbersReadAsTheyAre) {
  EXPECT_EQ(in_pixels(0.0213), "0.021 px");
  EXPECT_EQ(in_pixels(770.4), "770 px");
  EXPECT_EQ(in_pixels(std::numeric_limits<double>::infinity()), "without limit");
  EXPECT_EQ(in_percent(0.0), "0.0 %");
  EXPECT_EQ(in_percent(1e-5), "less than 0.1 %");
  EXPECT_EQ(in_percent(0.364), "36.4 %");
  EXPECT_EQ(in_percent(0.99999), "more than 99.9 %");
  EXPECT_EQ(in_percent(1.0), "100.0 %");
}

/// A hole straight ahead and a light mass beside it; the frame is `fov` wide and four tiles long.
Plan hole_seen_within(double fov, Choice finite_distance = Choice::Auto) {
  Scene scene;
  scene.camera.width = 256;
  scene.camera.height = 64;
  scene.camera.fov_rad = fov;
  scene.lenses = {{1e4, {0, 0, -1e9}}, {1.0, {1e7, 1e6, -2e9}}, {0.0, {0, 0, -1e9}}};
  scene.surfaces = {LatLong{}};
  TraceSettings settings;
  settings.finite_distance = finite_distance;
  return plan_trace(scene, settings);
}

TEST(PlanWords, WhereTheWholeFilmIsNearMassesEverythingIsExact) {
  const Plan plan = hole_seen_within(1e-4);
  EXPECT_EQ(plan.near_masses, 1.0);
  EXPECT_EQ(plan.bound_px, 0.0);
  for (const std::size_t i : {0, 1}) {
    EXPECT_EQ(plan.lenses[i].law, Law::Exact);
    EXPECT_FALSE(plan.lenses[i].culled);
    EXPECT_EQ(plan.lenses[i].moves_px, std::numeric_limits<double>::infinity());
    EXPECT_EQ(plan.lenses[i].reason, "the whole film is near masses");
  }
  EXPECT_EQ(plan.lenses[2].reason, "it has no mass");
  EXPECT_TRUE(plan.choices.front().on);
  EXPECT_EQ(plan.choices.front().share, 1.0);
  EXPECT_EQ(plan.choices.front().reason, "the whole film is near masses");
  EXPECT_EQ(describe(plan), "planes: 3 lenses, 2 exact, 1 culled; finite distance on; within 0 px");
}

TEST(PlanWords, WhereAPartOfTheFilmIsNearMassesTheySayHowMuch) {
  const Plan plan = hole_seen_within(0.6);
  EXPECT_EQ(plan.near_masses, 0.5);  // the two tiles in the middle
  EXPECT_THAT(plan.lenses[0].reason, HasSubstr("; exact near masses (50.0 % of the film)"));
  const EffectPlan& finite = plan.choices.front();
  EXPECT_FALSE(finite.on);
  EXPECT_EQ(finite.share, 0.5);
  EXPECT_THAT(finite.reason, HasSubstr("on near masses (50.0 % of the film); elsewhere it would move"));
  EXPECT_THAT(describe(plan),
              HasSubstr("; finite distance off; nothing left out near masses (50.0 % of the film); within "));
}

TEST(PlanWords, AFiniteDistanceSwitchedOffHasNoLimitNearMasses) {
  const Plan plan = hole_seen_within(0.6, Choice::Off);
  const EffectPlan& finite = plan.choices.front();
  EXPECT_EQ(finite.share, 0.0);
  EXPECT_EQ(finite.bound_px, std::numeric_limits<double>::infinity());
  EXPECT_THAT(finite.reason, HasSubstr("switched off; "));
  EXPECT_THAT(finite.reason, HasSubstr("near masses there is no limit"));
  EXPECT_THAT(describe(plan), HasSubstr("; without limit"));
}

TEST(PlanWords, LensesAtOnePlaceAreOneBody) {
  Scene scene;
  scene.camera.width = scene.camera.height = 64;
  scene.camera.fov_rad = 0.01;
  scene.lenses = {{1e-3, {1e7, 0, -1e9}}, {1e-3, {1e7, 0, -1e9}}};
  scene.surfaces = {LatLong{}};
  const Plan plan = plan_trace(scene, TraceSettings{});
  EXPECT_THAT(plan.lenses[0].reason, Not(HasSubstr("one body")));
  EXPECT_EQ(plan.lenses[1].reason, "one body with a lens at its place");
}

}  // namespace
}  // namespace lensplane
