// SPDX-License-Identifier: Apache-2.0

#include "src/lens_map.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numeric>

#include "tests/src/scenes.h"

namespace lensplane {
namespace {

// Table 1 of the paper, reproduced to this share by the geometry of docs/seed-paper.md.
constexpr double kAmplificationError = 0.01;

double hits_of(const Scene& scene) {
  const auto maps = trace_maps(Tracer(scene, plan_trace(scene, Method::ShinotsukaMakino)));
  return std::accumulate(maps[0].valid.begin(), maps[0].valid.end(), 0.0);
}

double amplification_of(const Scene& scene) {
  Scene without = scene;
  without.lenses.clear();
  return hits_of(scene) / hits_of(without);
}

TEST(LensMap, AmplificationsAreThoseOfThePapersTable) {
  constexpr int kResolution = 800;
  const Vec3 none(0);
  EXPECT_NEAR(amplification_of(seed_scene(kResolution, none, none, none)) / 4.46, 1, kAmplificationError);
  EXPECT_NEAR(amplification_of(seed_fig6(kResolution)) / 2.50, 1, kAmplificationError);
  const std::pair<double, double> moving[] = {
      {4.293e6, 1.92}, {3.250e6, 2.67}, {1.975e6, 3.89}, {0.636e6, 4.34}};
  for (const auto& [x, published] : moving) {
    const Scene scene = seed_scene(kResolution, {x - 2e6, 0, 0}, {x, 0, 0}, {x + 2e6, 0, 0});
    EXPECT_NEAR(amplification_of(scene) / published, 1, kAmplificationError) << x;
  }
}

TEST(LensMap, IdentityIsExactInFloat) {
  Scene scene;
  scene.camera.width = 641;
  scene.camera.height = 353;
  scene.camera.overscan = 6;
  scene.camera.fov_rad = 1;
  scene.surfaces = {Plate{}};
  const LensMap map = trace_maps(Tracer(scene, plan_trace(scene, Method::ShinotsukaMakino))).front();
  ASSERT_EQ(map.width, 653);
  ASSERT_EQ(map.height, 365);
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const auto at = static_cast<std::size_t>(row * map.width + column);
      ASSERT_EQ(map.s[at], static_cast<float>((column - 6 + 0.5) / 641));
      ASSERT_EQ(map.t[at], static_cast<float>(1 - (row - 6 + 0.5) / 353));
      ASSERT_EQ(map.valid[at], 1.0F);
    }
  }
}

TEST(LensMap, DoesNotDependOnTheNumberOfThreads) {
  Scene scene = seed_fig6(300);
  scene.surfaces.push_back(Plate{});
  scene.surfaces.push_back(LatLong{});
  const Tracer tracer(scene, plan_trace(scene, Method::ShinotsukaMakino));
  const auto trace_with = [&tracer](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return trace_maps(tracer);
  };
  const auto one = trace_with(1);
  for (const std::size_t threads : {2U, 7U}) {
    const auto many = trace_with(threads);
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(one[k].s, many[k].s);
      EXPECT_EQ(one[k].t, many[k].t);
      EXPECT_EQ(one[k].valid, many[k].valid);
    }
  }
}

TEST(LensMap, WhereNotValidEverythingIsZero) {
  Scene scene = seed_scene(301, Vec3(0), Vec3(0), Vec3(0));
  const LensMap map = trace_maps(Tracer(scene, plan_trace(scene, Method::ShinotsukaMakino))).front();
  int invalid = 0;
  for (std::size_t i = 0; i < map.s.size(); ++i) {
    if (map.valid[i] == 1.0F) continue;
    ++invalid;
    ASSERT_EQ(map.s[i], 0.0F);
    ASSERT_EQ(map.t[i], 0.0F);
    ASSERT_EQ(map.valid[i], 0.0F);
  }
  EXPECT_GT(invalid, 0);
}

}  // namespace
}  // namespace lensplane
