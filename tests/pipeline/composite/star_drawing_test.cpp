// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_drawing.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "tests/src/scenes.h"

namespace lensplane {
namespace {

Picture black(int width, int height, int overscan = 0) {
  Picture picture{width + 2 * overscan, height + 2 * overscan, -overscan, -overscan, width, height, {}};
  picture.pixels.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height),
                        {});
  return picture;
}

Rgb sum_of(const Picture& picture) {
  Rgb sum{0, 0, 0};
  for (const Rgba& pixel : picture.pixels) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
  }
  return sum;
}

StarImage image_at(FilmPosition film) {
  return {0, film, 1, {4, 2, 1}};
}

TEST(StarDrawing, KeepsTheLightAtAnyPlaceBetweenPixels) {
  for (const double sigma : {0.1, 0.6, 3.0}) {
    for (int i = 0; i < 200; ++i) {
      Picture picture = black(64, 64);
      const StarImage image = image_at({30 + 0.0173 * i, 31 + 0.0091 * i});
      draw_stars({&image, 1}, {sigma}, picture);
      const Rgb sum = sum_of(picture);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / image.light[c], 1, 1e-5) << sigma << " " << i;
    }
  }
}

TEST(StarDrawing, DotsHaveTheirPlaceAndWidth) {
  for (const double shift : {0.0, 0.3, 0.77}) {
    Picture picture = black(40, 40);
    const StarImage image = image_at({20 + shift, 17.5 - shift});
    draw_stars({&image, 1}, {1.5}, picture);
    double x = 0, y = 0, xx = 0;
    for (int row = 0; row < 40; ++row) {
      for (int column = 0; column < 40; ++column) {
        const double share = picture.at(column, row)[1] / image.light[1];
        x += share * (column + 0.5), y += share * (row + 0.5);
        xx += share * std::pow(column + 0.5 - image.film.x, 2);
      }
    }
    EXPECT_NEAR(x, image.film.x, 1e-3);
    EXPECT_NEAR(y, image.film.y, 1e-3);
    // A pixel is as wide as 1/sqrt(12) itself.
    EXPECT_NEAR(std::sqrt(xx - 1.0 / 12), 1.5, 3e-3);
  }
}

TEST(StarDrawing, AddsLightAndLeavesAlphaAlone) {
  Picture picture = black(9, 9);
  for (Rgba& pixel : picture.pixels) pixel = {1, 1, 1, 0.5F};
  const std::vector<StarImage> two = {image_at({4.5, 4.5}), image_at({4.5, 4.5})};
  draw_stars(two, {}, picture);
  const double share = std::pow(std::erf(0.5 / 0.6 / std::sqrt(2.0)), 2);
  EXPECT_NEAR(picture.at(4, 4)[0], 1 + 2 * 4 * share, 1e-3);
  for (const Rgba& pixel : picture.pixels) EXPECT_EQ(pixel[3], 0.5F);
}

TEST(StarDrawing, CutsDotsAtTheEdgeAndKnowsOverscan) {
  Picture picture = black(20, 10);
  const std::vector<StarImage> edge = {image_at({0, 5}), image_at({20, 10}), image_at({-9, 5}),
                                       image_at({5, 1e9})};
  draw_stars(edge, {}, picture);
  EXPECT_NEAR(sum_of(picture)[1], 2 * (0.5 + 0.25), 1e-5);
  Picture wide = black(20, 10, 5);
  draw_stars(edge, {}, wide);
  EXPECT_NEAR(sum_of(wide)[1], 2 * 2, 1e-5);
  EXPECT_EQ(wide.at(5, 10), picture.at(0, 5));
}

TEST(StarDrawing, DoesNotDependOnTheNumberOfThreads) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-5, 205);
  std::vector<StarImage> images;
  for (int i = 0; i < 5000; ++i) images.push_back(image_at({place(random), place(random)}));
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Picture picture = black(200, 200);
    draw_stars(images, {}, picture);
    return picture.pixels;
  };
  const auto one = with(1);
  EXPECT_EQ(one, with(2));
  EXPECT_EQ(one, with(7));
}

/// The light that a picture of one star adds up to, in units of the unlensed star.
double drawn(const Scene& scene, FilmPosition star) {
  const StarField field = star_field({{direction_from_pixel(scene.camera, star), 2, 0.6}});
  const Tracer tracer(scene, plan_trace(scene, TraceSettings{}));
  Picture picture = black(scene.camera.width, scene.camera.height);
  const PointSpread spread;
  draw_stars(find_star_images(tracer, field, {.margin_px = spread.reach_px()}), spread, picture);
  return sum_of(picture)[1] / field.light[0][1];
}

TEST(StarDrawing, ADriftingStarDoesNotFlicker) {
  Scene scene;
  scene.camera.width = 300;
  scene.camera.height = 200;
  scene.camera.fov_rad = 0.5;
  for (int i = 0; i < 200; ++i) EXPECT_NEAR(drawn(scene, {50 + 0.973 * i, 60 + 0.41 * i}), 1, 5e-3) << i;
}

TEST(StarDrawing, ALensedDriftingStarHasTheLightThatTheLensEquationGives) {
  Scene scene;
  scene.camera.width = 300;
  scene.camera.height = 200;
  scene.camera.fov_rad = 1e-4;
  const double einstein = 20 * slope_per_pixel(scene.camera);  // 20 pixels
  scene.lenses = {{einstein * einstein * 1e9 / 4, {0, 0, -1e9}}};
  for (int i = 0; i < 200; ++i) {
    const double x = -30 + 0.303 * i, y = 3.0, u = std::hypot(x, y) / 20;
    const double expected = (u * u + 2) / (u * std::sqrt(u * u + 4));
    EXPECT_NEAR(drawn(scene, {150 + x, 100 + y}), expected, 0.005 * expected) << i;
  }
}

}  // namespace
}  // namespace lensplane
