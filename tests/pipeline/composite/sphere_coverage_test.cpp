// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/sphere_coverage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/composite/compositor.h"
#include "src/constants.h"

namespace lensplane {
namespace {

Camera camera_of(int width, int height, double fov_rad) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fov_rad = fov_rad;
  return camera;
}

// The share of rays at the edge against the area: 64 rays in each of the pixels along it.
constexpr double kCoverageError = 1e-3;

TEST(SphereCoverage, IsTheAreaOfTheDiscOnTheFilm) {
  const Camera camera = camera_of(200, 150, 0.02);
  for (const double pixels : {3.0, 20.5, 60.0}) {  // radius; so narrow a view is flat
    const Sphere sphere{{1, -2, -1e6}, pixels * 1e6 * 0.02 / 200, {}};
    EXPECT_NEAR(covered_without_lenses(camera, sphere, {}) / (kPi * pixels * pixels), 1,
                kCoverageError * 20 / pixels);
  }
}

// The compositor stops at 16 rays where they agree well enough.
constexpr double kAdaptiveError = 0.004;

TEST(SphereCoverage, CountsAsTheCompositorDoes) {
  for (const Projection projection : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    Scene scene;
    scene.camera = camera_of(90, 60, 1.5);
    scene.camera.projection = projection;
    scene.camera.overscan = 2;
    const Sphere sphere{{0.4, 0.3, -3}, 1, {}};
    scene.surfaces = {sphere};
    TraceSettings settings;
    settings.effects.jacobian = true;
    const Picture white{1, 1, 0, 0, 1, 1, {{1, 1, 1, 1}}};
    const SurfaceLook look{std::make_shared<const Texture>(white, Wrap::Clamp), {}, {}, {}};
    const Composite seen = composite(Tracer(scene, plan_trace(scene, settings)), {look}, {});
    EXPECT_NEAR(covered_without_lenses(scene.camera, sphere, {}), seen.hits[0],
                kAdaptiveError * seen.hits[0]);
    EXPECT_GT(seen.hits[0], 90);
  }
}

TEST(SphereCoverage, FromInsideIsTheWholeFrameAndBehindNothing) {
  const Camera camera = camera_of(40, 30, 1);
  EXPECT_EQ(covered_without_lenses(camera, {{0, 0, 1}, 5, {}}, {}), 40 * 30);
  EXPECT_EQ(covered_without_lenses(camera, {{0, 0, 100}, 5, {}}, {}), 0);
}

}  // namespace
}  // namespace lensplane
