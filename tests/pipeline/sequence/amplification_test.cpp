// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/amplification.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/composite/compositor.h"
#include "pipeline/shot/shot_scene.h"
#include "src/constants.h"
#include "tests/pipeline/shot/example_shot.h"

namespace lensplane {
namespace {

// Of the area of a disc of 60 pixels and more, by up to 64 rays a pixel on its rim.
constexpr double kAreaError = 1e-3;

// Beside that, what the small angles of the lens equation leave out.
constexpr double kLensedError = 5e-3;

constexpr double kDistance = 1e9;  // metres

/// A square frame of 300 pixels and a sphere, its image never read.
Shot shot_with(const std::string& sphere, const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings = {
      "camera.resolution=[300, 300]", "camera.fov=2 deg",
      "layers.earth={name: earth, type: sphere, image: none.png, " + sphere + "}",
      "layers.background={name: b, type: latlong, image: none.png}"};
  settings.insert(settings.end(), more.begin(), more.end());
  return example_shot(settings);
}

/// Pixels that a sphere straight ahead covers: a disc, its rim at the angle asin(radius/distance).
double area_of(double radius) {
  const double tangent = radius / std::sqrt(kDistance * kDistance - radius * radius);
  const double pixels = tangent / (2 * std::tan(kPi / 180) / 300);
  return kPi * pixels * pixels;
}

constexpr const char* kAhead = "centre: [0 m, 0 m, -1e9 m], radius: 8e6 m";

Tracer tracer_at(const Shot& shot, double frame, bool lenses) {
  Scene scene = scene_at(shot, frame);
  if (!lenses) scene.lenses.clear();
  TraceSettings settings = trace_at(shot, frame);
  settings.effects.jacobian = true;
  return {scene, plan_trace(scene, settings)};
}

/// Pixels that each surface covers, as the compositor counts them.
std::vector<double> covered_pixels(const Tracer& tracer) {
  const Picture white{1, 1, 0, 0, 1, 1, {{1, 1, 1, 1}}};
  const SurfaceLook plain{std::make_shared<const Texture>(white, Wrap::Clamp), {}, {}, {}};
  return composite(tracer, std::vector<SurfaceLook>(tracer.surfaces().size(), plain), {}).hits;
}

TEST(Amplification, IsTheCoveredAreaOverThatOfTheDiscWithoutLenses) {
  const Shot shot = shot_with(kAhead);
  const auto found = amplifications_of(shot, 1001, {2.5 * area_of(8e6), 1e9});
  ASSERT_EQ(found.size(), 1U);  // skies have none
  EXPECT_EQ(found[0].layer, "earth");
  EXPECT_NEAR(found[0].factor.value(), 2.5, 2.5 * kAreaError);
}

TEST(Amplification, OfASphereAloneWithoutLensesIsOne) {
  // Stars are no surface.
  const Shot alone = shot_with(kAhead, {"layers.b={name: b, type: stars, catalogue: none.csv}"});
  const auto covered = covered_pixels(tracer_at(alone, 1001, false));
  ASSERT_EQ(covered.size(), 1U);
  EXPECT_NEAR(covered[0] / area_of(8e6), 1, kAreaError);
  EXPECT_NEAR(amplifications_of(alone, 1001, covered)[0].factor.value(), 1, kAreaError);
  // Before a sky its rim may get other rays.
  const Shot before_sky = shot_with(kAhead);
  const auto with_sky = covered_pixels(tracer_at(before_sky, 1001, false));
  EXPECT_NEAR(amplifications_of(before_sky, 1001, with_sky)[0].factor.value(), 1, kAreaError);
}

TEST(Amplification, OfADiscOnTheAxisIsWhatTheLensEquationGives) {
  // Half way before it a lens with an Einstein radius of 0.8 of the disc's: sqrt(1 + 4/rho^2), rho = 1/0.8.
  const double einstein = 0.8 * 8e6 / kDistance;
  const double m = einstein * einstein * (0.5 * kDistance) * kDistance / (4 * 0.5 * kDistance);
  const Shot shot = shot_with(kAhead, {"lenses.near={name: near, radius: " + std::to_string(2 * m) +
                                       " m, position: [0 m, 0 m, -5e8 m]}"});
  const auto covered = covered_pixels(tracer_at(shot, 1001, true));
  const double expected = std::sqrt(1 + 4 * 0.8 * 0.8);
  EXPECT_NEAR(amplifications_of(shot, 1001, covered)[0].factor.value() / expected, 1, kLensedError);
}

TEST(Amplification, IsNothingOffTheFrame) {
  const Shot off = shot_with("centre: [1e8 m, 0 m, -1e9 m], radius: 8e6 m");
  EXPECT_EQ(amplifications_of(off, 1001, {100, 1})[0].factor, std::nullopt);
  const Shot behind = shot_with("centre: [0 m, 0 m, 1e9 m], radius: 8e6 m");
  EXPECT_EQ(amplifications_of(behind, 1001, {100, 1})[0].factor, std::nullopt);
  EXPECT_TRUE(
      amplifications_of(example_shot({"layers.earth={name: e, type: plate, image: a.png}"}), 1001, {1, 1})
          .empty());
}

TEST(Amplification, IsOfTheMeanOverTheShutter) {
  // The radius doubles in a frame: 1.25 and 1.75 of it at the two moments.
  const Shot shot = shot_with("centre: [0 m, 0 m, -1e9 m], radius: {keys: {1001: 4e6 m, 1002: 8e6 m}}",
                              {"camera.shutter={open: 0, close: 1, samples: 2}"});
  const double mean = (area_of(5e6) + area_of(7e6)) / 2;
  EXPECT_NEAR(amplifications_of(shot, 1001, {3 * mean, 1})[0].factor.value(), 3, 3 * kAreaError);
  // In the frame at one of two moments: half of its area is what there is.
  const Shot passing = shot_with(
      "centre: {keys: {1001: [0 m, 0 m, -1e9 m], 1001.5: [1e8 m, 0 m, -1e9 m]}, interpolate: step}, radius: "
      "6e6 m",
      {"camera.shutter={open: 0, close: 1, samples: 2}"});
  EXPECT_NEAR(amplifications_of(passing, 1001, {area_of(6e6), 1})[0].factor.value(), 2, 2 * kAreaError);
}

TEST(Amplification, TextBringsItBack) {
  const std::vector<Amplification> two = {{"earth", 4.4612345678901234}, {"moon", std::nullopt}};
  EXPECT_EQ(text_from_amplifications({{"earth", 4.5}, {"moon", std::nullopt}}), "earth 4.5 moon -");
  const auto back = amplifications_from_text(text_from_amplifications(two));
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].layer, "earth");
  EXPECT_EQ(back[0].factor, two[0].factor);
  EXPECT_EQ(back[1].layer, "moon");
  EXPECT_EQ(back[1].factor, std::nullopt);
  EXPECT_EQ(text_from_amplifications({}), "");
  EXPECT_TRUE(amplifications_from_text("").empty());
}

}  // namespace
}  // namespace lensplane
