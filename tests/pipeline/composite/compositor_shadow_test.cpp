// SPDX-License-Identifier: Apache-2.0
//
// Where light ends in masses: how much of which pixels, and what lies before it.

#include <gtest/gtest.h>

#include <numeric>

#include "pipeline/composite/compositor.h"
#include "src/constants.h"
#include "src/lens_map.h"
#include "src/surfaces.h"

namespace lensplane {
namespace {

constexpr double kShadowRadius = 11.3;  // pixels
constexpr int kSize = 48;
constexpr double kFarAway = 1e6;  // metres to the mass, of 1 m

SurfaceLook flat(const Rgba& colour) {
  return {std::make_shared<const Texture>(Picture{1, 1, 0, 0, 1, 1, {colour}}, Wrap::Clamp)};
}

const SurfaceLook kWhite = flat({1, 1, 1, 1}), kClear = flat({0, 0, 0, 0}),
                  kHalf = flat({0.25F, 0.25F, 0.25F, 0.5F});

/// A black hole in the middle of the frame whose shadow has that radius: 3 sqrt(3) m.
Scene hole_before(const std::vector<Surface>& surfaces) {
  Scene scene;
  scene.camera.width = scene.camera.height = kSize;
  scene.camera.fov_rad = 2 * std::atan(3 * std::sqrt(3.0) / kFarAway / kShadowRadius * kSize / 2);
  scene.lenses = {{1, {0, 0, -kFarAway}}};
  scene.surfaces = surfaces;
  return scene;
}

Tracer tracer_of(const Scene& scene, Method method = Method::Planes) {
  TraceSettings settings;
  settings.method = method;
  if (method == Method::Planes) settings.law = Law::Exact, settings.finite_distance = Choice::Off;
  settings.effects.jacobian = true;
  return {scene, plan_trace(scene, settings)};
}

double sum_of(const std::vector<float>& shadow) {
  return std::accumulate(shadow.begin(), shadow.end(), 0.0);
}

const double kArea = kPi * kShadowRadius * kShadowRadius;
constexpr std::size_t kMiddle = kSize / 2 * kSize + kSize / 2;

TEST(CompositorShadow, IsTheAreaOfAllCapturedLight) {
  const Sphere aside{{4e7, 0, -2e7}, 1e5, {}};  // not on the film
  for (const std::vector<Surface>& surfaces :
       std::vector<std::vector<Surface>>{{LatLong{}}, {Plate{}}, {aside}, {Plate{true}}, {}}) {
    for (const Method method : {Method::Planes, Method::Geodesic}) {
      const bool fills_frame = !surfaces.empty() && is_bent(surfaces.front());  // the shadow, too
      const std::vector<SurfaceLook> looks(surfaces.size(), fills_frame ? kClear : kWhite);
      const Composite result = composite(tracer_of(hole_before(surfaces), method), looks, {});
      EXPECT_NEAR(sum_of(result.shadow) / kArea, 1, 0.01);
      EXPECT_EQ(result.shadow[kMiddle], 1);
      EXPECT_EQ(result.shadow[0], 0);
    }
  }
}

TEST(CompositorShadow, LeavesNoGapBesideAnOpaqueSky) {
  Composite result = composite(tracer_of(hole_before({LatLong{}})), {kWhite}, {});
  EXPECT_EQ(result.picture.pixels[kMiddle], (Rgba{0, 0, 0, 0}));
  blacken_shadow(result);
  EXPECT_EQ(result.picture.pixels[kMiddle], (Rgba{0, 0, 0, 1}));
  int edges = 0;
  for (std::size_t i = 0; i < result.shadow.size(); ++i) {
    EXPECT_NEAR(result.picture.pixels[i][3], 1, 1e-6);
    EXPECT_NEAR(result.picture.pixels[i][0], 1 - result.shadow[i], 1e-6);
    edges += result.shadow[i] > 0 && result.shadow[i] < 1 ? 1 : 0;
  }
  EXPECT_GT(edges, 60);
}

TEST(CompositorShadow, LiesUnderWhatStandsBefore) {
  // Two balls of a third of the shadow's radius, side by side before it, one opaque.
  const double nearer = kFarAway / 10, px = 3 * std::sqrt(3.0) / kShadowRadius / 10;
  const std::vector<Surface> surfaces = {Sphere{{-5 * px, 0, -nearer}, 3 * px, {}},
                                         Sphere{{5 * px, 0, -nearer}, 3 * px, {}}};
  Composite result = composite(tracer_of(hole_before(surfaces)), {kWhite, kHalf}, {});
  const std::size_t opaque = kMiddle - 5, half = kMiddle + 5;
  EXPECT_EQ(result.shadow[opaque], 0);
  EXPECT_EQ(result.shadow[half], 0.5F);
  const double disc = kPi * 9;
  EXPECT_NEAR(sum_of(result.shadow), kArea - 1.5 * disc, 0.01 * kArea);
  blacken_shadow(result);
  EXPECT_EQ(result.picture.pixels[opaque], (Rgba{1, 1, 1, 1}));
  EXPECT_EQ(result.picture.pixels[half], (Rgba{0.25F, 0.25F, 0.25F, 1}));
  EXPECT_EQ(result.picture.pixels[kMiddle], (Rgba{0, 0, 0, 1}));
}

TEST(CompositorShadow, IsNotTakenForNothing) {
  Scene scene = hole_before({Sphere{{4e7, 0, -2e7}, 1e5, {}}});
  scene.camera.width = scene.camera.height = 5 * kSize;
  const Tracer tracer = tracer_of(scene);
  Plan plan = tracer.plan();
  plan.effects = {};
  plan.effects.shadow = true;
  EmptySpace empty(scene.camera);
  empty.learn(trace_maps(Tracer(scene, plan)), 0, {0, scene.camera.height});
  const Composite known = composite(tracer, {kWhite}, {}, empty), unknown = composite(tracer, {kWhite}, {});
  EXPECT_GT(sum_of(unknown.shadow), 0.9 * kArea);
  EXPECT_EQ(known.shadow, unknown.shadow);
  EXPECT_LT(known.rays, unknown.rays);
}

TEST(CompositorShadow, WithoutMassesThereIsNone) {
  Scene scene = hole_before({LatLong{}});
  scene.lenses.clear();
  EXPECT_EQ(sum_of(composite(tracer_of(scene), {kWhite}, {}).shadow), 0);
}

}  // namespace
}  // namespace lensplane
