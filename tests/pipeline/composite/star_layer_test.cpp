// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_layer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/composite/compositor.h"
#include "tests/pipeline/composite/reference_filter.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

// A dot is scaled to its light: floats, and the search for where it is.
constexpr double kSteady = 1e-3;

// Of the light of all images of a star behind a lens.
constexpr double kLensedError = 0.005;

std::shared_ptr<const Texture> flat(const Rgba& colour) {
  return std::make_shared<const Texture>(Picture{1, 1, 0, 0, 1, 1, {colour}}, Wrap::Clamp);
}

Scene empty_scene(double fov_rad = 0.1) {
  Scene scene;
  scene.camera.width = 100;
  scene.camera.height = 80;
  scene.camera.fov_rad = fov_rad;
  return scene;
}

/// The green light that stars at film positions add to a picture of the scene, over that of one star without
/// anything in its way.
double light_of(const Scene& scene, const std::vector<SurfaceLook>& looks,
                const std::vector<FilmPosition>& at) {
  std::vector<Star> stars;
  for (const FilmPosition film : at) stars.push_back({direction_from_pixel(scene.camera, film), 3, 0.6});
  const StarField field = star_field(stars);
  TraceSettings settings;
  settings.effects.jacobian = true;
  Picture picture = blank_picture(scene.camera);
  add_stars(Tracer(scene, plan_trace(scene, settings)), looks, field, picture);
  double light = 0;
  for (const Rgba& pixel : picture.pixels) light += static_cast<double>(pixel[1]);
  return light / field.light[0][1];
}

TEST(StarLayer, SpheresHideWhatIsBehindThem) {
  Scene scene = empty_scene();
  const double radius = 1e6 * 20 * slope_per_pixel(scene.camera);  // 20 pixels
  scene.surfaces = {Sphere{{0, 0, -1e6}, radius, {}}};
  const std::vector<SurfaceLook> looks = {{flat({1, 1, 1, 1})}};
  EXPECT_EQ(light_of(scene, looks, {{50, 40}}), 0);
  EXPECT_EQ(light_of(scene, looks, {{50 + 19.9, 40}}), 0);
  EXPECT_NEAR(light_of(scene, looks, {{50 + 20.1, 40}}), 1, kSteady);
  EXPECT_NEAR(light_of(scene, looks, {{50, 40}, {20, 40}, {50, 70}}), 2, kSteady);
  // In the dark, too.
  EXPECT_EQ(light_of(scene, {{flat({1, 1, 1, 1}), Vec3(0, 0, -1)}}, {{50, 40}}), 0);
}

TEST(StarLayer, PlatesDimByTheirAlphaAndSkiesDoNot) {
  Scene scene = empty_scene();
  const Picture picture = painted(100, 80, [](int column, int) {
    const float alpha = column < 50 ? 0.75F : 0.0F;
    return Rgba{alpha, 0, 0, alpha};
  });
  const SurfaceLook plate{std::make_shared<const Texture>(picture, Wrap::Black)}, sky{flat({1, 1, 1, 1})};
  for (const Surface& surface : {Surface(Plate{}), Surface(Card{1e3})}) {
    scene.surfaces = {LatLong{}, surface};
    EXPECT_NEAR(light_of(scene, {sky, plate}, {{25, 40}}), 0.25, kSteady);
    EXPECT_NEAR(light_of(scene, {sky, plate}, {{75, 40}}), 1, kSteady);
    // Two behind one another let a sixteenth through.
    scene.surfaces.push_back(surface);
    EXPECT_NEAR(light_of(scene, {sky, plate, plate}, {{25, 40}}), 0.0625, kSteady);
  }
  scene.surfaces = {LatLong{}};
  EXPECT_NEAR(light_of(scene, {sky}, {{25, 40}}), 1, kSteady);
  scene.surfaces = {Plate{}};
  EXPECT_EQ(light_of(scene, {{flat({0, 0, 0, 1})}}, {{25, 40}}), 0);
}

TEST(StarLayer, DimsEveryImageOfManyByWhatIsBeforeIt) {
  // More than a batch, behind a plate whose alpha grows from the left to the right.
  Scene scene = empty_scene();
  scene.surfaces = {Plate{}};
  const Picture ramp = painted(100, 1, [](int column, int) {
    return Rgba{0, 0, 0, static_cast<float>(column) / 100};
  });
  const std::vector<SurfaceLook> looks = {{std::make_shared<const Texture>(ramp, Wrap::Clamp)}};
  TraceSettings settings;
  settings.effects.jacobian = true;
  const Tracer tracer(scene, plan_trace(scene, settings));
  std::vector<StarImage> images;
  for (int i = 0; i < 300; ++i) images.push_back({0, {5 + 0.3 * i, 40}, 1, {4, 2, 1}});
  dim_hidden(tracer, looks, images);
  for (const StarImage& image : images) {
    const double clear = 1 - (image.film.x - 0.5) / 100;
    EXPECT_NEAR(image.light[0], 4 * clear, 1e-4);
    EXPECT_NEAR(image.light[2], 1 * clear, 1e-4);
  }
  std::vector<StarImage> none;
  dim_hidden(tracer, looks, none);
  EXPECT_TRUE(none.empty());
}

TEST(StarLayer, ADriftingStarKeepsItsLight) {
  Scene scene = empty_scene();
  scene.surfaces = {LatLong{}};
  const std::vector<SurfaceLook> looks = {{flat({0, 0, 0, 1})}};
  for (int i = 0; i < 400; ++i) {
    EXPECT_NEAR(light_of(scene, looks, {{20 + 0.1 * i, 30 + 0.037 * i}}), 1, kSteady) << i;
  }
}

TEST(StarLayer, ImagesOfALensedStarAddUpToItsAmplification) {
  Scene scene = empty_scene(1e-4);
  const double einstein = 15 * slope_per_pixel(scene.camera);
  scene.lenses = {{einstein * einstein * 1e9 / 4, {0, 0, -1e9}}};
  scene.surfaces = {LatLong{}};
  const std::vector<SurfaceLook> looks = {{flat({0, 0, 0, 1})}};
  for (int i = 0; i < 120; ++i) {
    const double x = -9 + 0.151 * i, y = 2.5, u = std::hypot(x, y) / 15;
    const double expected = (u * u + 2) / (u * std::sqrt(u * u + 4));
    EXPECT_NEAR(light_of(scene, looks, {{50 + x, 40 + y}}) / expected, 1, kLensedError) << i;
  }
}

TEST(StarLayer, ImagesAreHiddenWhereTheyAreSeenNotWhereTheStarIs) {
  // A star behind the middle of a ball that stands before a lens: without it hidden, with it seen round it.
  Scene scene = empty_scene(1e-4);
  const double pixel = slope_per_pixel(scene.camera), einstein = 20 * pixel;
  scene.surfaces = {Sphere{{0, 0, -5e8}, 5e8 * 10 * pixel, {}}};
  const std::vector<SurfaceLook> looks = {{flat({1, 1, 1, 1})}};
  EXPECT_EQ(light_of(scene, looks, {{54, 40}}), 0);
  scene.lenses = {{einstein * einstein * 1e9 / 4, {0, 0, -1e9}}};
  const double u = 4.0 / 20, all = (u * u + 2) / (u * std::sqrt(u * u + 4));
  EXPECT_NEAR(light_of(scene, looks, {{54, 40}}) / all, 1, kLensedError);
  // As large as to cover one of the two images, at (u +- sqrt(u^2 + 4))/2 Einstein radii: 22.1 and 18.1.
  scene.surfaces = {Sphere{{0, 0, -5e8}, 5e8 * 20 * pixel, {}}};
  EXPECT_NEAR(light_of(scene, looks, {{54, 40}}) / ((all + 1) / 2), 1, kLensedError);
}

}  // namespace
}  // namespace lensplane
