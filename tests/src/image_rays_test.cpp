// SPDX-License-Identifier: Apache-2.0
//
// Rays over images: their areas against those of ellipses and annuli, and square by square.

#include "src/image_rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/constants.h"

namespace lensplane {
namespace {

// Of the area of a whole image; of what is cut by the sides of squares.
constexpr double kWholeError = 3e-3, kCutError = 0.01;

/// An image centred `x`, `y` pixels beside (0.5, 0.5), with axes of `major` and `minor` pixels, turned.
BodyImage ellipse(double x, double y, double major, double minor, double turn, double inner) {
  const double c = std::cos(turn), s = std::sin(turn);
  BodyImage image{{0.1, 0.7}, 0, 0, {c / major, s / major, -s / minor, c / minor}, inner, 1.0};
  const double off_x = image.at.x - 0.5 - x, off_y = image.at.y - 0.5 - y;
  image.u = image.by_film.u_x * off_x + image.by_film.u_y * off_y;
  image.v = image.by_film.v_x * off_x + image.by_film.v_y * off_y;
  return image;
}

double area_of(const std::vector<ImageRay>& rays) {
  double sum = 0;
  for (const ImageRay& ray : rays) sum += ray.area;
  return sum;
}

const struct {
  double major, minor, inner;
} kShapes[] = {{0.02, 0.02, 0},    {0.05, 0.05, 0}, {0.45, 0.45, 0},    {3, 0.05, 0},    {8, 0.3, 0},
               {2.5, 2.5, 0},      {0.4, 0.4, 0.9}, {20, 20, 0.985},    {20, 0.03, 0.9}, {5, 3, 0.99},
               {0.05, 0.05, 0.98}, {30, 0.4, 0.3},  {0.3, 0.02, 0.995}, {6, 6, 0.75},    {300, 0.5, 0}};

TEST(ImageRays, OfAWholeImageHaveItsArea) {
  for (const auto& shape : kShapes) {
    for (const double turn : {0.0, 0.4, 1.1, 2.0}) {
      const BodyImage image = ellipse(0.13, -0.21, shape.major, shape.minor, turn, shape.inner);
      double sum = 0;
      const int reach = static_cast<int>(shape.major) + 2;
      for (int row = -reach; row <= reach; ++row) {
        for (int column = -reach; column <= reach; ++column) {
          const FilmSquare square{{double(column), double(row)}, 1};
          const std::vector<ImageRay> rays = rays_over(image, square);
          sum += area_of(rays);
          for (const ImageRay& ray : rays) {
            ASSERT_TRUE(square.holds(ray.film)) << shape.major << ' ' << shape.minor;
            ASSERT_TRUE(image.holds(ray.film)) << shape.major << ' ' << shape.minor;
          }
        }
      }
      const double area = kPi * shape.major * shape.minor * (1 - shape.inner * shape.inner);
      EXPECT_NEAR(sum / area, 1, kWholeError) << shape.major << ' ' << shape.minor << ' ' << shape.inner;
    }
  }
}

TEST(ImageRays, CoverWhatLiesInASquare) {
  for (const auto& shape : kShapes) {
    if (shape.minor < 0.3 || shape.inner > 0.95) continue;  // wide enough for a grid of points to tell
    const BodyImage image = ellipse(0.6, 0.3, shape.major, shape.minor, 0.3, shape.inner);
    const FilmSquare square{{0, 0}, 1};
    constexpr int kGrid = 1000;
    double inside = 0;
    for (int n = 0; n < kGrid * kGrid; ++n) {
      inside += image.holds({(n % kGrid + 0.5) / kGrid, (n / kGrid + 0.5) / kGrid}) ? 1 : 0;
    }
    EXPECT_NEAR(area_of(rays_over(image, square)), inside / (kGrid * kGrid), kCutError)
        << shape.major << ' ' << shape.minor << ' ' << shape.inner;
  }
}

TEST(ImageRays, AreNoneWhereTheImageIsNot) {
  const FilmSquare square{{0, 0}, 1};
  EXPECT_TRUE(rays_over(ellipse(5, 0, 2, 1, 0, 0), square).empty());
  EXPECT_TRUE(rays_over(ellipse(0, 0, 20, 20, 0, 0.99), square).empty());  // in the annulus' hole
  EXPECT_TRUE(rays_over(BodyImage{}, square).empty());                     // of no extent
  EXPECT_FALSE(rays_over(ellipse(2.4, 0, 2, 1, 0, 0), square).empty());
}

}  // namespace
}  // namespace lensplane
