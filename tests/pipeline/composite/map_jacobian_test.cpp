// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/map_jacobian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/lens_map.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

/// A map that shows a picture of its own size as it is.
StMap identity(int width, int height) {
  StMap map{width, height, 0, 0, width, height, false, {}, {}, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      map.s.push_back(static_cast<float>((column + 0.5) / width));
      map.t.push_back(static_cast<float>(1 - (row + 0.5) / height));
      map.coverage.push_back(1);
    }
  }
  return map;
}

constexpr int kSize = 40;
constexpr MappedPicture kPicture{kSize, kSize, false, false};

void expect_identity(const StMap& map, const MappedPicture& picture) {
  const auto footprints = footprints_from_differences(map, picture);
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    if (map.coverage[i] == 0) continue;
    const Footprint& f = footprints[i];
    ASSERT_NEAR(f.ds_dx * map.width, 1, 1e-4) << i;
    ASSERT_NEAR(f.dt_dy * map.height, -1, 1e-4) << i;
    ASSERT_NEAR(f.ds_dy * map.height, 0, 1e-4) << i;
    ASSERT_NEAR(f.dt_dx * map.width, 0, 1e-4) << i;
  }
}

TEST(MapJacobian, IdentityCoversOnePixel) {
  expect_identity(identity(kSize, kSize), kPicture);
  expect_identity(identity(kSize, 1 + kSize), {kSize, 1 + kSize, false, false});
}

TEST(MapJacobian, PaintedHolesAndSilhouettesAreNotReached) {
  StMap map = identity(kSize, kSize);
  for (int row = 10; row < 20; ++row) {
    for (int column = 15; column < 22; ++column) {
      map.coverage[map.index(column, row)] = 0;
      map.s[map.index(column, row)] = 7;
    }
  }
  expect_identity(map, kPicture);
}

TEST(MapJacobian, CutsAreNotCrossed) {
  StMap map = identity(kSize, kSize);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 17; column < kSize; ++column) map.s[map.index(column, row)] += 0.4F;
  }
  expect_identity(map, kPicture);
}

TEST(MapJacobian, AStripOfOnePixelIsASingleSample) {
  StMap map = identity(kSize, kSize);
  for (int row = 0; row < kSize; ++row) map.s[map.index(17, row)] = 0.95F;
  const auto footprints = footprints_from_differences(map, kPicture);
  EXPECT_EQ(footprints[map.index(17, 9)].ds_dx, 0);
  EXPECT_NEAR(footprints[map.index(17, 9)].dt_dy * kSize, -1, 1e-4);
  EXPECT_NEAR(footprints[map.index(16, 9)].ds_dx * kSize, 1, 1e-4);
}

TEST(MapJacobian, TheSeamOfALatLongMapIsNoJump) {
  StMap map = identity(kSize, kSize);
  for (float& s : map.s) s = s < 0.5F ? s + 0.5F : s - 0.5F;
  expect_identity(map, {kSize, kSize, true, false});
  // The last column before the seam has its only neighbour behind it.
  for (int row = 0; row < kSize; ++row) map.coverage[map.index(kSize / 2 - 2, row)] = 0;
  expect_identity(map, {kSize, kSize, true, false});
}

TEST(MapJacobian, APictureMuchLargerThanTheMapIsFilteredWhole) {
  expect_identity(identity(kSize, kSize), {100 * kSize, 100 * kSize, false, false});
}

TEST(MapJacobian, WhatWasPaintedIntoATracedMapHasDifferences) {
  const StMap map = identity(kSize, kSize);
  MapJacobian jacobian;
  for (auto* channel : {&jacobian.ds_dx, &jacobian.ds_dy, &jacobian.dt_dx, &jacobian.dt_dy})
    channel->assign(map.s.size(), 0.F);
  jacobian.ds_dx[5] = 2;
  const auto footprints = footprints_from_jacobian(map, jacobian, kPicture);
  EXPECT_EQ(footprints[5].ds_dx, 2);
  EXPECT_EQ(footprints[5].dt_dy, 0);
  EXPECT_NEAR(footprints[6].ds_dx * kSize, 1, 1e-4);
}

/// The traced map of a scene's only surface, with its jacobian.
struct TracedMap {
  StMap map;
  MapJacobian jacobian;
};

TracedMap traced(const Scene& scene) {
  TraceSettings settings;
  settings.effects.jacobian = true;
  LensMap map = trace_maps(Tracer(scene, plan_trace(scene, settings))).front();
  const auto copy = [](const UnsetVector<float>& values) {
    return std::vector<float>(values.begin(), values.end());
  };
  const auto pass = [&](std::size_t k) { return copy(map.passes[k].values); };
  return {
      {map.width, map.height, 0, 0, map.width, map.height, false, copy(map.s), copy(map.t), copy(map.valid)},
      {pass(0), pass(1), pass(2), pass(3)}};
}

double length(const Footprint& f, const MappedPicture& picture) {
  return std::hypot(f.ds_dx * picture.width, f.dt_dx * picture.height, 0.0) +
         std::hypot(f.ds_dy * picture.width, f.dt_dy * picture.height, 0.0);
}

/// Shares of the covered pixels whose footprint differs from the traced one by more than a fifth of it and
/// half a pixel, and of those where it is more than three times as long: where the picture would be smeared.
struct Differences {
  double wrong;
  double smeared;
};

Differences differences(const TracedMap& scene, const MappedPicture& picture) {
  const auto robust = footprints_from_differences(scene.map, picture);
  const auto exact = footprints_from_jacobian(scene.map, scene.jacobian, picture);
  double covered = 0, wrong = 0, smeared = 0;
  for (std::size_t i = 0; i < robust.size(); ++i) {
    if (scene.map.coverage[i] == 0) continue;
    ++covered;
    const Footprint &a = robust[i], &b = exact[i];
    const Footprint off{a.ds_dx - b.ds_dx, a.ds_dy - b.ds_dy, a.dt_dx - b.dt_dx, a.dt_dy - b.dt_dy};
    wrong += length(off, picture) > 0.2 * length(b, picture) + 0.5;
    smeared += length(a, picture) > 3 * length(b, picture) + 2;
  }
  return {wrong / covered, smeared / covered};
}

Scene lensed(Surface surface, double lens_radius) {
  Scene scene;
  scene.camera.width = 320;
  scene.camera.height = 240;
  scene.camera.fov_rad = 40 * kDegree;
  scene.lenses = {{lens_radius / 2, {3, 2, -100}}, {lens_radius / 3, {-15, -4, -130}}};
  scene.surfaces = {surface};
  return scene;
}

TEST(MapJacobian, FollowsTheTracedOneAcrossCriticalCurvesAndUpToShadows) {
  const Differences plate = differences(traced(lensed(Plate{}, 2)), {320, 240, false, false});
  EXPECT_LT(plate.wrong, 0.01);
  EXPECT_EQ(plate.smeared, 0);
  const Differences sky = differences(traced(lensed(LatLong{}, 2)), {2048, 1024, true, false});
  EXPECT_LT(sky.wrong, 0.01);
  EXPECT_EQ(sky.smeared, 0);
  const Differences ball =
      differences(traced(lensed(Sphere{{0, 0, -400}, 60, {}}, 2)), {2048, 1024, true, false});
  EXPECT_LT(ball.wrong, 0.03);
  EXPECT_EQ(ball.smeared, 0);
}

}  // namespace
}  // namespace lensplane
