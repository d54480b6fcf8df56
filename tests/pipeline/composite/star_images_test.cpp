// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_images.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/src/scenes.h"

namespace lensplane {
namespace {

double luminance(const Rgb& c) {
  return 0.2722287168 * c[0] + 0.6740817658 * c[1] + 0.0536895174 * c[2];
}

TEST(StarImages, LightFollowsMagnitudeAndExposure) {
  const std::vector<Star> stars = {
      {Vec3(0, 0, -1), 0, 0.6}, {Vec3(0, 0, -1), 5, 0.6}, {Vec3(0, 0, -1), 0, 1.5}};
  const StarField field = star_field(stars), brighter = star_field(stars, 2);
  EXPECT_NEAR(luminance(field.light[0]), kLightOfMagnitudeZero, 1e-8);
  EXPECT_NEAR(luminance(field.light[1]), kLightOfMagnitudeZero / 100, 1e-10);
  EXPECT_NEAR(luminance(field.light[2]), kLightOfMagnitudeZero, 1e-8);
  EXPECT_GT(field.light[2][0], field.light[0][0]);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(brighter.light[1][c], 4 * field.light[1][c], 1e-12);
}

TEST(StarImages, AreTheStarsTimesTheirMagnification) {
  Scene scene;
  scene.camera.width = scene.camera.height = 400;
  scene.camera.fov_rad = 4e-5;
  scene.lenses = {{1e-10 * 1e9 / 4, {0, 0, -1e9}}};                   // an Einstein radius of 100 pixels
  const Vec3 aside = direction_from_pixel(scene.camera, {250, 200});  // half of that
  const StarField field = star_field({{Vec3(0, 0, 1), 1, 0.6}, {aside, 3, 1.0}});
  const Tracer tracer(scene,
                      plan_trace(scene, TraceSettings{Method::Planes, Law::Weak, 0.05, Choice::Off, {}}));
  const auto images = find_star_images(tracer, field);
  ASSERT_EQ(images.size(), 2U);
  double sum = 0;
  for (const StarImage& image : images) {
    EXPECT_EQ(image.star, 1U);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_DOUBLE_EQ(image.light[c], field.light[1][c] * std::abs(image.magnification));
    }
    sum += luminance(image.light);
  }
  EXPECT_NEAR(sum / luminance(field.light[1]), 2.18282, 1e-3);  // (u^2 + 2)/(u sqrt(u^2 + 4)) of u = 1/2
}

}  // namespace
}  // namespace lensplane
