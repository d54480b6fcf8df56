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

/// The camera of a picture, of so narrow a view that all its pixels are alike.
Camera narrow_camera(const Picture& picture) {
  Camera camera;
  camera.width = picture.display_width;
  camera.height = picture.display_height;
  camera.overscan = -picture.x;
  camera.fov_rad = 1e-3;
  return camera;
}

void draw(std::span<const StarImage> images, const PointSpread& spread, Picture& picture) {
  draw_stars(images, spread, narrow_camera(picture), picture);
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
      draw({&image, 1}, {sigma}, picture);
      const Rgb sum = sum_of(picture);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / image.light[c], 1, 1e-5) << sigma << " " << i;
    }
  }
}

TEST(StarDrawing, DotsHaveTheirPlaceAndWidth) {
  for (const double shift : {0.0, 0.3, 0.77}) {
    Picture picture = black(40, 40);
    const StarImage image = image_at({20 + shift, 17.5 - shift});
    draw({&image, 1}, {1.5}, picture);
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
  draw(two, {}, picture);
  const double share = std::pow(std::erf(0.5 / 0.6 / std::sqrt(2.0)), 2);
  EXPECT_NEAR(picture.at(4, 4)[0], 1 + 2 * 4 * share, 1e-3);
  for (const Rgba& pixel : picture.pixels) EXPECT_EQ(pixel[3], 0.5F);
}

TEST(StarDrawing, CutsDotsAtTheEdgeAndKnowsOverscan) {
  Picture picture = black(20, 10);
  const std::vector<StarImage> edge = {image_at({0, 5}), image_at({20, 10}), image_at({-9, 5}),
                                       image_at({5, 1e9})};
  draw(edge, {}, picture);
  EXPECT_NEAR(sum_of(picture)[1], 2 * (0.5 + 0.25), 1e-5);
  Picture wide = black(20, 10, 5);
  draw(edge, {}, wide);
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
    draw(images, {}, picture);
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
  const ImageSearch search{.margin_px = spread.reach_px(scene.camera)};
  draw_stars(find_star_images(tracer, field, search), spread, scene.camera, picture);
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

/// What the pixels of the frame show of one star: the sum of each times its solid angle, the mean place on
/// the sky, and the mean square of the angle from the star.
struct OnSky {
  double light = 0;
  Vec3 place{0};
  double spread2 = 0;
};

/// By rays within every pixel, in the frame alone.
OnSky seen_on_sky(const Scene& scene, const Vec3& star) {
  const StarField field = star_field({{star, 2, 0.6}});
  const Tracer tracer(scene, plan_trace(scene, TraceSettings{}));
  const Camera& camera = scene.camera;
  Picture picture = black(camera.width, camera.height, camera.overscan);
  const PointSpread spread{1.0};
  draw_stars(find_star_images(tracer, field, {.margin_px = spread.reach_px(camera)}), spread, camera,
             picture);
  OnSky seen;
  const Vec3 local = camera.axes.local_from_parent(star);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const double value = picture.at(column - picture.x, row - picture.y)[1] / field.light[0][1];
      if (value == 0) continue;
      constexpr int kParts = 4;
      for (int part = 0; part < kParts * kParts; ++part) {
        const FilmPosition film{column + (part % kParts + 0.5) / kParts,
                                row + (part / kParts + 0.5) / kParts};
        const Vector<Dual> d = direction_from_film<Dual>(camera, film);
        const Vec3 right(d.x.dx, d.y.dx, d.z.dx), down(d.x.dy, d.y.dy, d.z.dy), here(d.x.v, d.y.v, d.z.v);
        const double weight = value * right.cross(down).length() / (kParts * kParts);
        seen.light += weight;
        seen.place += here * weight;
        seen.spread2 += weight * (here - local).length2();
      }
    }
  }
  seen.place /= seen.light;
  seen.spread2 /= seen.light;
  return seen;
}

/// The light is the middle's, and so is the look.
void expect_as_in_the_middle(const Scene& scene, const Vec3& star, double shape_error = 0.08) {
  const double pixel = pixel_angle(scene.camera);
  const OnSky seen = seen_on_sky(scene, star);
  EXPECT_NEAR(seen.light / (pixel * pixel), 1, 0.01);
  EXPECT_LT((seen.place - scene.camera.axes.local_from_parent(star)).length(), 0.1 * pixel);
  // The Gaussian, and the pixels' own size twice: they are means, and are spread over themselves here.
  const auto film = film_from_direction(scene.camera, scene.camera.axes.local_from_parent(star));
  const Vector<Dual> d = direction_from_film<Dual>(scene.camera, {film->x, film->y});
  double size2 = 0;
  for (const Dual& along : {d.x, d.y, d.z}) size2 += along.dx * along.dx + along.dy * along.dy;
  EXPECT_NEAR(seen.spread2, 2 * pixel * pixel + size2 / 6, 2 * shape_error * pixel * pixel);
}

Vec3 towards(double longitude, double latitude) {  // degrees
  const double lon = longitude * kDegree, lat = latitude * kDegree;
  return {std::sin(lon) * std::cos(lat), std::sin(lat), -std::cos(lon) * std::cos(lat)};
}

TEST(StarDrawing, StarsOfALatLongPictureAreAlikeEverywhere) {
  for (const int height : {150, 512}) {
    Scene scene;
    scene.camera.projection = Projection::LatLong;
    scene.camera.height = height;
    scene.camera.width = 2 * height;
    for (const double latitude : {0.0, 30.0, -60.0, 75.0, 80.0, -85.0, 88.0, 89.5, 89.99, 90.0, -90.0}) {
      for (const double longitude : {20.0, -179.95, 180.0}) {  // at the seam, too
        SCOPED_TRACE(testing::Message() << height << " at " << longitude << ", " << latitude);
        expect_as_in_the_middle(scene, towards(longitude, latitude));
      }
    }
  }
}

TEST(StarDrawing, OverscanOfALatLongPictureShowsWhatItGoesOnWith) {
  Scene scene;
  scene.camera.projection = Projection::LatLong;
  scene.camera.height = 128;
  scene.camera.width = 256;
  scene.camera.overscan = 20;
  const std::vector<Star> stars = {{towards(179, 10), 1, 0},
                                   {towards(-120, 86), 1, 0},
                                   {towards(60, -70), 1, 0},
                                   {towards(178, 71), 1, 0}};
  const Tracer tracer(scene, plan_trace(scene, TraceSettings{}));
  Picture picture = black(256, 128, 20);
  const PointSpread spread;
  draw_stars(find_star_images(tracer, star_field(stars), {.margin_px = spread.reach_px(scene.camera)}),
             spread, scene.camera, picture);
  const auto at = [&](int column, int row) { return picture.at(column + 20, row + 20)[1]; };
  float most = 0;
  for (int row = -20; row < 148; ++row) {
    for (int column = -20; column < 276; ++column) {
      const bool beyond = row < 0 || row >= 128;
      const int same_row = row < 0 ? -1 - row : row >= 128 ? 255 - row : row;
      const int same_column = (column + 256 + (beyond ? 128 : 0)) % 256;
      EXPECT_NEAR(at(column, row), at(same_column, same_row), 1e-4) << column << " " << row;
      most = std::max(most, at(column, row));
    }
  }
  EXPECT_GT(most, 0.5F);
}

TEST(StarDrawing, StarsOfAFisheyeAreAlikeEverywhere) {
  Scene scene;
  scene.camera.projection = Projection::Fisheye;
  scene.camera.width = scene.camera.height = 300;
  scene.camera.fov_rad = 220 * kDegree;
  for (const double angle : {0.0, 30.0, 60.0, 90.0, 105.0}) {
    for (const double turn : {0.0, 0.7, 2.5}) {
      SCOPED_TRACE(testing::Message() << angle << " " << turn);
      const double a = angle * kDegree;
      expect_as_in_the_middle(scene,
                              {std::sin(a) * std::cos(turn), std::sin(a) * std::sin(turn), -std::cos(a)});
    }
  }
}

TEST(StarDrawing, StarsOfAWidePerspectiveAreAlikeOnTheFilm) {
  Scene scene;
  scene.camera.width = 400;
  scene.camera.height = 300;
  scene.camera.fov_rad = 100 * kDegree;
  for (int i = 0; i < 30; ++i) EXPECT_NEAR(drawn(scene, {10.3 + 12.91 * i, 20 + 8.7 * i}), 1, 1e-4) << i;
}

}  // namespace
}  // namespace lensplane
