// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/fingerprint.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/temporary_folder.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

std::string print_of(const Scene& scene, Method method = Method::ShinotsukaMakino) {
  return fingerprint_of_trace(scene, plan_trace(scene, method)).digest();
}

TEST(Fingerprint, IsTheSameForTheSameAndAnotherForEveryChange) {
  const Scene scene = seed_fig6(100);
  EXPECT_EQ(print_of(scene), print_of(seed_fig6(100)));
  EXPECT_EQ(print_of(scene).size(), 40U);
  std::set<std::string> prints = {print_of(scene), print_of(scene, Method::Kishi)};
  std::vector<Scene> changed(22, scene);
  changed[0].camera.width = 101;
  changed[1].camera.overscan = 2;
  changed[2].camera.fov_rad *= 1 + 1e-15;
  changed[3].camera.position.y = 1e-9;
  changed[4].camera.axes = basis_from_zxy({0, 1e-9, 0});
  changed[5].lenses[1].m *= 1 + 1e-15;
  changed[6].lenses.pop_back();
  changed[7].surfaces.push_back(Plate{});
  changed[8].surfaces.push_back(LatLong{});
  changed[9].camera.height = 101;
  changed[10].lenses[2].position.z *= 1 + 1e-15;
  auto sphere = [&](std::size_t i) -> Sphere& { return std::get<Sphere>(changed[i].surfaces[0]); };
  sphere(11).centre.x = 1e-9;
  sphere(12).radius *= 1 + 1e-15;
  sphere(13).axes = basis_from_zxy({0, 0, 1e-9});
  changed[14].camera.projection = Projection::Fisheye;
  changed[15].surfaces.push_back(Card{1});
  changed[16].surfaces.push_back(Card{2});
  changed[17].surfaces.push_back(Card{1, 1});
  changed[18].surfaces.push_back(Ring{{0, 0, -1}, {}, 1, 2});
  changed[19].surfaces.push_back(Ring{{0, 0, -1}, {}, 1, 3});
  changed[20].surfaces.push_back(Ring{{0, 0, -1}, {}, 1, 2, 1});
  changed[21].surfaces.push_back(Ring{{0, 1, -1}, {}, 1, 2});
  for (const Scene& other : changed) prints.insert(print_of(other));
  EXPECT_EQ(prints.size(), 24U);
}

TEST(Fingerprint, IsAnotherForEveryChangeOfThePlanThatMovesLight) {
  const Scene scene = seed_fig6(100);
  Plan plan = plan_trace(scene, Method::Planes);
  plan.tiles = {64, 2, 2, {0, 0, 0, 0}};
  const auto print = [&](const Plan& p) { return fingerprint_of_trace(scene, p).digest(); };
  ASSERT_FALSE(plan.recipes.empty());
  ASSERT_FALSE(plan.recipes[0].planes.empty());
  std::set<std::string> prints = {print(plan), print(plan_trace(scene, Method::Geodesic))};
  std::vector<Plan> changed(10, plan);
  const auto recipe = [&](std::size_t i) -> Deflectors& { return changed[i].recipes[0]; };
  recipe(0).planes[0].deflectors[0].law = Law::SecondOrder;
  recipe(1).planes[0].deflectors[0].index += 1e-15;
  recipe(2).planes.pop_back();
  recipe(3).finite_distance = !plan.recipes[0].finite_distance;
  recipe(4).outward -= 1;
  changed[5].recipes.push_back(plan.recipes[0]);
  changed[6].tiles.level[3] = 1;
  changed[7].tiles.size = 32;
  recipe(8).planes[0].deflectors[0].lens += 1;
  changed[9].method = Method::Geodesic;
  for (const Plan& other : changed) prints.insert(print(other));
  EXPECT_EQ(prints.size(), 12U);
  Plan other_effects = plan;
  other_effects.effects.jacobian = true;
  EXPECT_EQ(print(other_effects), print(plan));
}

TEST(Fingerprint, GeodesicCountsByItsTolerance) {
  const Scene scene = seed_fig6(100);
  Plan plan = plan_trace(scene, Method::Geodesic);
  const std::string before = fingerprint_of_trace(scene, plan).digest();
  plan.geodesic_tolerance *= 2;
  EXPECT_NE(fingerprint_of_trace(scene, plan).digest(), before);
}

/// The passes of a data file do not change the map beside it.
TEST(Fingerprint, EffectsChangeNoLaw) {
  const Scene scene = seed_fig6(100);
  TraceSettings settings;
  const std::string without = fingerprint_of_trace(scene, plan_trace(scene, settings)).digest();
  for (const EffectName& entry : kEffectNames) settings.effects.*entry.effect = true;
  EXPECT_EQ(fingerprint_of_trace(scene, plan_trace(scene, settings)).digest(), without);
}

TEST(Fingerprint, TextsDoNotRunTogether) {
  EXPECT_NE(Fingerprint().add("ab").add("c").digest(), Fingerprint().add("a").add("bc").digest());
}

TEST(Fingerprint, FilesCountByTheirContents) {
  const TemporaryFolder folder;
  const auto a = folder.write("a", "one"), b = folder.write("b", "one"), c = folder.write("c", "two");
  const auto print = [](const std::filesystem::path& path) { return Fingerprint().add_file(path).digest(); };
  EXPECT_EQ(print(a), print(b));
  EXPECT_NE(print(a), print(c));
  EXPECT_EQ(refusal_of([&] { print(folder / "none"); }).code, ExitCode::BadInput);
}

}  // namespace
}  // namespace lensplane
