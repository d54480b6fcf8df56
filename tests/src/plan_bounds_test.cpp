// SPDX-License-Identifier: Apache-2.0
//
// The plan keeps its word: on thousands of random scenes what it leaves out moves nothing by more than it
// says.

#include "src/plan_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "src/accuracy.h"
#include "src/constants.h"
#include "src/tracer.h"

namespace lensplane {
namespace {

/// Scenes of all sizes and projections, with masses in and outside the frame, far and near, some behind the
/// camera, some side by side.
class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : random_(seed) {}

  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  double spread(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }

  /// With skies, some with plates.
  Scene next() {
    Scene scene;
    Camera& camera = scene.camera;
    camera.width = 192;
    camera.height = 128;
    camera.fov_rad = spread(1e-4, 2.5);
    const auto kind = random_() % 4;
    if (kind == 2) camera.projection = Projection::LatLong;
    if (kind == 3) camera.projection = Projection::Fisheye, camera.fov_rad = uniform(0.1, 2 * kPi);
    scene.surfaces = {LatLong{}};
    if (kind == 0) scene.surfaces.push_back(Plate{});
    const double distance = spread(1e3, 1e20);
    const auto count = 1 + random_() % 6;
    for (unsigned long i = 0; i < count; ++i) add_lens(distance, scene);
    return scene;
  }

  /// The same with balls as well: before, between and behind the masses, some round them.
  Scene next_with_balls() {
    Scene scene = next();
    const double z = -scene.lenses.front().position.z;
    for (int i = 0; i < 2; ++i) {
      const double distance = std::abs(z) * spread(0.2, 20);
      const double width = std::min(1.0, std::tan(std::min(scene.camera.fov_rad, 2.8) / 2));
      const Vec3 centre(distance * width * uniform(-1, 1), distance * width * uniform(-0.7, 0.7), -distance);
      scene.surfaces.push_back(Sphere{centre, distance * width * uniform(0.1, 0.6), {}});
    }
    return scene;
  }

  /// A scene with a card or a ring that faces the camera, before, between and behind the masses, often at the
  /// depth of one.
  Scene next_with_body() {
    Scene scene = next();
    scene.camera.projection = Projection::Perspective;
    scene.camera.fov_rad = std::min(scene.camera.fov_rad, 2.5);
    const Vec3 at_mass = scene.lenses.front().position;
    const double depth = random_() % 3 == 0 ? std::abs(at_mass.z) : std::abs(at_mass.z) * spread(0.2, 5);
    if (random_() % 2 == 0) {
      scene.surfaces = {Card{depth}};
    } else {
      const double size = depth * std::tan(scene.camera.fov_rad / 2);
      scene.surfaces = {Ring{
          {0.3 * size * uniform(-1, 1), 0, -depth}, basis_from_zxy({kPi / 2, 0, 0}), 0.1 * size, 2 * size}};
    }
    return scene;
  }

 private:
  void add_lens(double distance, Scene& scene) {
    const double z = distance * spread(0.1, 10);
    const double width = std::min(1.0, std::tan(std::min(scene.camera.fov_rad, 2.8) / 2));
    const double m = z * spread(1e-12, 1e-3) * width;
    Vec3 position(z * width * uniform(-2, 2), z * width * uniform(-2, 2), -z);
    if (random_() % 8 == 0) position.z = -position.z;
    scene.lenses.push_back({m, position});
    if (random_() % 5 == 0) {
      scene.lenses.push_back({m * spread(0.01, 1), position + Vec3(m * spread(10, 1e6), 0, 0)});
    }
  }

  std::mt19937 random_;
};

/// How often each simplification was used, and how near errors come to what may be left out.
struct Tally {
  int by_level[4] = {}, culled = 0, without_finite = 0, on_balls = 0;
  double nearest = 0.0;  // error over tolerance
  double nearest_on_balls = 0.0;
};

void count_choices(const Plan& plan, Tally& tally) {
  for (const std::uint8_t level : plan.tiles.level) ++tally.by_level[level];
  for (const LensPlan& lens : plan.lenses) tally.culled += lens.culled;
  tally.without_finite += !plan.choices.front().on;
}

/// Compares what random film positions see by the plan with what they see with everything on.
void hold_to_its_word(const Scene& scene, double tolerance_px, RandomScenes& random, Tally& tally) {
  Effects direction;
  direction.direction = true;
  const TraceSettings settings{Method::Planes, std::nullopt, tolerance_px, Choice::Auto, direction};
  const TraceSettings everything{Method::Planes, Law::Exact, tolerance_px, Choice::On, direction};
  Plan by_chords = plan_trace(scene, settings);
  // What masses do together beyond their company is not by choice.
  ASSERT_LE(by_chords.bound_px - by_chords.choices[1].bound_px, tolerance_px);
  by_chords.tiles.curved.clear();  // as the reference; what chords misplace is held to its word below
  const Tracer planned(scene, std::move(by_chords));
  const Tracer reference(scene, plan_trace(scene, everything));
  const Plan& plan = planned.plan();
  count_choices(plan, tally);
  TraceBatch a = planned.make_batch(), b = reference.make_batch();
  for (int i = 0; i < kBatchSize; ++i) {
    a.x[i] = b.x[i] = random.uniform(0, scene.camera.width);
    a.y[i] = b.y[i] = random.uniform(0, scene.camera.height);
  }
  planned.trace(a);
  reference.trace(b);
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const bool ball = std::holds_alternative<Sphere>(scene.surfaces[k]);
    for (int i = 0; i < kBatchSize; ++i) {
      // Near captured light everything is simulated: both agree on who is captured.
      const auto ray = static_cast<std::size_t>(i);
      ASSERT_EQ(a.surfaces[k].outcome[ray] == Outcome::Captured,
                b.surfaces[k].outcome[ray] == Outcome::Captured);
      const auto hit = [&](const TraceBatch& batch) {
        return batch.surfaces[k].outcome[ray] == Outcome::Hit;
      };
      if (!hit(a) || !hit(b)) continue;
      const double error =
          pixels_apart(scene.camera, planned.surfaces()[k], a.surfaces[k], b.surfaces[k], ray);
      ASSERT_LE(error, plan.bound_px + kRoundingPx) << "surface " << k << " film " << a.x[i] << " " << a.y[i];
      double& nearest = ball ? tally.nearest_on_balls : tally.nearest;
      nearest = std::max(nearest, error / tolerance_px);
      tally.on_balls += ball;
    }
  }
}

Tally hold_scenes_to_their_word(unsigned seed, int count, Scene (RandomScenes::*next)()) {
  RandomScenes scenes(seed);
  Tally tally;
  for (int n = 0; n < count && !testing::Test::HasFatalFailure(); ++n) {
    SCOPED_TRACE(n);
    const Scene scene = (scenes.*next)();
    const double tolerance_px = scenes.spread(1e-3, 1);
    hold_to_its_word(scene, tolerance_px, scenes, tally);
  }
  return tally;
}

TEST(PlanBounds, WhatIsLeftOutMovesNothingByMore) {
  const Tally tally = hold_scenes_to_their_word(7, 3000, &RandomScenes::next);
  // Not by doing everything always: each simplification is used, and some come near what they may leave out.
  for (const int count : tally.by_level) EXPECT_GT(count, 50);
  EXPECT_GT(tally.culled, 1000);
  EXPECT_GT(tally.without_finite, 500);
  EXPECT_GT(tally.nearest, 0.05);
}

TEST(PlanBounds, WhatIsLeftOutMovesNothingByMoreOnBalls) {
  const Tally tally = hold_scenes_to_their_word(8, 2000, &RandomScenes::next_with_balls);
  for (const int count : tally.by_level) EXPECT_GT(count, 50);
  EXPECT_GT(tally.on_balls, 10000);
  EXPECT_GT(tally.culled, 300);
  EXPECT_GT(tally.without_finite, 100);
  EXPECT_GT(tally.nearest_on_balls, 0.05);
}

TEST(PlanBounds, WhatIsLeftOutMovesNothingByMoreOnCardsAndRings) {
  const Tally tally = hold_scenes_to_their_word(8, 1500, &RandomScenes::next_with_body);
  EXPECT_GT(tally.without_finite, 100);
  EXPECT_GT(tally.nearest, 0.01);
}

TEST(PlanBounds, WithoutLensesNothingIsLeftOut) {
  Scene scene;
  scene.camera.width = 100;
  scene.camera.height = 50;
  scene.camera.fov_rad = 1;
  scene.surfaces = {Plate{}};
  const Plan plan = plan_trace(scene, TraceSettings{});
  EXPECT_EQ(plan.bound_px, 0.0);
  for (const std::uint8_t level : plan.tiles.level) EXPECT_EQ(level, 0);
}

TEST(PlanBounds, ALensThatMovesNothingIsCulled) {
  Scene scene;
  scene.camera.width = 1000;
  scene.camera.height = 500;
  scene.camera.fov_rad = 0.1;
  scene.surfaces = {Plate{}};
  scene.lenses = {{1e-3, {1e6, 0, -1e7}}, {1e3, {3e5, 1e5, -2e7}}};
  const Plan plan = plan_trace(scene, TraceSettings{});
  EXPECT_TRUE(plan.lenses[0].culled);
  EXPECT_GT(plan.lenses[0].moves_px, 0.0);
  EXPECT_FALSE(plan.lenses[1].culled);
  // By 4 m/b at the nearest that the frame comes to it, and by what the mass behind makes of that.
  const double b = 1e6 - 1e7 * std::tan(0.05);
  EXPECT_GE(plan.lenses[0].moves_px, 4e-3 / b / pixel_angle(scene.camera));
  EXPECT_LE(plan.lenses[0].moves_px, 10.0 * 4e-3 / b / pixel_angle(scene.camera));
}

TEST(PlanBounds, AGivenLawHasNoLimitWhereLightIsCaptured) {
  // One tile holds the whole film; its middle ray is captured, by the first mass or by one behind others.
  for (const bool alone : {true, false}) {
    Scene scene;
    scene.camera.width = 60;
    scene.camera.height = 40;
    scene.camera.fov_rad = 0.4;
    scene.surfaces = {LatLong{}};
    scene.lenses = {{1.0, {0, 0, -60}}};
    if (!alone) scene.lenses = {{1e-9, {1, 0, -20}}, {1.0, {0, 0, -60}}, {1e-9, {1, 0, -60}}};
    for (const Law law : {Law::Weak, Law::SecondOrder, Law::Exact}) {
      TraceSettings settings;
      settings.law = law;
      settings.finite_distance = Choice::On;
      const Plan plan = plan_trace(scene, settings);
      EXPECT_EQ(plan.bound_px == std::numeric_limits<double>::infinity(), law != Law::Exact);
      EXPECT_EQ(plan.lenses[alone ? 0 : 1].moves_px, std::numeric_limits<double>::infinity());
    }
    EXPECT_EQ(plan_trace(scene, TraceSettings{}).bound_px, 0.0);
  }
}

TEST(PlanBounds, TightensWithTheTolerance) {
  Scene scene;
  scene.camera.width = 640;
  scene.camera.height = 320;
  scene.camera.fov_rad = 0.05;
  scene.surfaces = {Plate{}};
  scene.lenses = {{1e4, {5e6, 0, -4e8}}, {1e4, {-6e6, 1e6, -5e8}}};
  std::size_t before = 0;
  for (const double tolerance : {10.0, 1.0, 1e-1, 1e-2, 1e-4}) {
    TraceSettings settings;
    settings.tolerance_px = tolerance;
    const Plan plan = plan_trace(scene, settings);
    EXPECT_LE(plan.bound_px - plan.choices[1].bound_px, tolerance);
    std::size_t work = 0;
    for (const std::uint8_t level : plan.tiles.level) work += level;
    EXPECT_GE(work, before) << tolerance;
    before = work;
  }
  EXPECT_GT(before, 0u);
}

}  // namespace
}  // namespace lensplane
