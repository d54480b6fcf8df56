// SPDX-License-Identifier: Apache-2.0

#include "src/point_images.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "src/film_area.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

constexpr double kDistance = 1e9;
constexpr double kEinstein = 1e-5;  // radians

/// The world direction that a camera at rest sees at `film` without masses.
Vec3 direction_at(const Scene& scene, FilmPosition film) {
  return scene.camera.axes.parent_from_local(direction_from_film<double>(scene.camera, film));
}

/// A film of 1000 x 500 pixels and a mass in its middle with an Einstein radius of 100 pixels.
Scene point_lens() {
  Scene scene;
  scene.camera.width = 1000;
  scene.camera.height = 500;
  scene.camera.fov_rad = 10 * kEinstein;
  scene.lenses = {{kEinstein * kEinstein * kDistance / 4, {0, 0, -kDistance}}};
  return scene;
}

Tracer tracer_of(const Scene& scene, Choice finite = Choice::Off) {
  return Tracer(scene, plan_trace(scene, TraceSettings{Method::Planes, Law::Weak, 0.05, finite, {}}));
}

std::vector<PointImage> images_of(const Scene& scene, const std::vector<Vec3>& points,
                                  const ImageSearch& search = {}) {
  return find_point_images(tracer_of(scene), DirectionIndex(points), search);
}

double total(const std::vector<PointImage>& images) {
  return std::accumulate(images.begin(), images.end(), 0.0, [](double sum, const PointImage& image) {
    return sum + std::abs(image.magnification);
  });
}

double amplification(double u) {
  return (u * u + 2) / (u * std::sqrt(u * u + 4));
}

TEST(PointImages, OfAPointLensAreTheTwoThatTheLensEquationHas) {
  const Scene scene = point_lens();
  for (const double u : {0.002, 0.01, 0.05, 0.3, 1.0, 1.3, 2.0}) {
    for (const double turn : {0.1, 2.0, 4.4}) {
      const double x = 100 * u * std::cos(turn), y = 100 * u * std::sin(turn);
      const auto images = images_of(scene, {direction_at(scene, {500 + x, 250 + y})});
      ASSERT_EQ(images.size(), 2U) << u << " " << turn;
      EXPECT_NEAR(total(images), amplification(u), 1e-5 * amplification(u)) << u;
      for (const PointImage& image : images) {
        const double along = (u + std::copysign(std::sqrt(u * u + 4), image.magnification)) / 2;
        EXPECT_NEAR(image.film.x, 500 + along / u * x, 1e-5) << u;
        EXPECT_NEAR(image.film.y, 250 + along / u * y, 1e-5) << u;
      }
    }
  }
}

TEST(PointImages, AreFoundWhereTheLensIsMuchSmallerThanAPixel) {
  // Einstein radii of 1, 0.3 and 0.1 pixels, the mass anywhere in a cell.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-20, 20), turn(0, 2 * kPi);
  for (const double pixels : {1.0, 0.3, 0.1}) {
    for (int i = 0; i < 30; ++i) {
      Scene scene = point_lens();
      scene.camera.fov_rad = 1000 / pixels * kEinstein;
      const FilmPosition mass{500 + place(random), 250 + place(random)};
      scene.lenses[0].position = direction_at(scene, mass) * kDistance;
      for (const double u : {0.3, 1.0, 3.0}) {
        const double phi = turn(random);
        const Vec3 star =
            direction_at(scene, {mass.x + u * pixels * std::cos(phi), mass.y + u * pixels * std::sin(phi)});
        EXPECT_NEAR(total(images_of(scene, {star})), amplification(u), 2e-3 * amplification(u))
            << pixels << " " << u;
      }
    }
  }
}

TEST(PointImages, OnACausticAddUpToNoMoreThanIsAllowed) {
  const Scene scene = point_lens();
  const auto images = images_of(scene, {direction_at(scene, {500, 250})});
  EXPECT_GT(images.size(), 2U);
  EXPECT_NEAR(total(images), 1e4, 1e-6);
}

TEST(PointImages, TooFaintOnesAreLeftOut) {
  const Scene scene = point_lens();
  const Vec3 star = direction_at(scene, {700, 250});
  EXPECT_EQ(images_of(scene, {star}, {.least_magnification = 0.02}).size(), 2U);
  EXPECT_EQ(images_of(scene, {star}, {.least_magnification = 0.04}).size(), 1U);
}

/// Stars over the frame and somewhat beyond.
std::vector<Vec3> random_stars(const Scene& scene, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x(-0.1 * scene.camera.width, 1.1 * scene.camera.width),
      y(-0.1 * scene.camera.height, 1.1 * scene.camera.height);
  std::vector<Vec3> stars;
  for (int i = 0; i < count; ++i) stars.push_back(direction_at(scene, {x(random), y(random)}));
  return stars;
}

/// Three masses at three depths, Einstein radii of 30 to 60 pixels.
Scene three_masses() {
  Scene scene = point_lens();
  scene.camera.width = 400;
  scene.camera.height = 300;
  scene.camera.fov_rad = 4 * kEinstein;
  const double m = scene.lenses[0].m, pixel = kEinstein / 100 * kDistance;
  scene.lenses = {{0.2 * m, {-60 * pixel, 20 * pixel, -kDistance}},
                  {0.3 * m, {80 * pixel, -30 * pixel, -1.3 * kDistance}},
                  {0.1 * m, {10 * pixel, 70 * pixel, -0.8 * kDistance}}};
  return scene;
}

/// The sky seen through a grid over the film, `step` pixels wide.
struct Grid {
  int columns, rows;
  std::vector<SkyRay> rays;

  const SkyRay& at(int i, int j) const { return rays[static_cast<std::size_t>(j * columns + i)]; }
};
Grid trace_grid(const Scene& scene, double step) {
  Grid grid{
      static_cast<int>(scene.camera.width / step) + 1, static_cast<int>(scene.camera.height / step) + 1, {}};
  std::vector<FilmPosition> films;
  for (int j = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.columns; ++i) films.push_back({i * step, j * step});
  }
  grid.rays = SkyRays(tracer_of(scene)).trace(films);
  return grid;
}

/// Is the star in the triangle, by the sides of its edges on which it lies?
bool holds(const SkyRay& a, const SkyRay& b, const SkyRay& c, const Vec3& star) {
  const Vec3 p = a.direction - star, q = b.direction - star, r = c.direction - star;
  const bool pq = p.cross(q).dot(star) >= 0, qr = q.cross(r).dot(star) >= 0, rp = r.cross(p).dot(star) >= 0;
  return pq == qr && qr == rp;
}

/// Every image by brute force: each triangle of a fine grid, in which the map is taken to be linear.
std::vector<PointImage> images_of_grid(const Grid& grid, const DirectionIndex& stars, double least) {
  std::vector<PointImage> images;
  const auto visit = [&](const SkyRay& a, const SkyRay& b, const SkyRay& c) {
    if (!a.seen || !b.seen || !c.seen || std::abs(a.magnification) < least) return;
    const double reach = std::max((b.direction - a.direction).length(), (c.direction - a.direction).length());
    for (const std::size_t i : stars.within(a.direction, reach)) {
      if (holds(a, b, c, stars.directions()[i])) images.push_back({i, a.film, a.magnification});
    }
  };
  for (int j = 0; j + 1 < grid.rows; ++j) {
    for (int i = 0; i + 1 < grid.columns; ++i) {
      visit(grid.at(i, j), grid.at(i + 1, j), grid.at(i, j + 1));
      visit(grid.at(i + 1, j), grid.at(i + 1, j + 1), grid.at(i, j + 1));
    }
  }
  return images;
}

/// How many of `images`, those that are not faint, have none of the same star in `others` nearer than
/// `near` pixels.
int without_partner(const std::vector<PointImage>& images, const std::vector<PointImage>& others,
                    double least, double near) {
  return static_cast<int>(std::count_if(images.begin(), images.end(), [&](const PointImage& a) {
    return std::abs(a.magnification) > least &&
           std::none_of(others.begin(), others.end(), [&](const PointImage& b) {
             return a.point == b.point && std::hypot(a.film.x - b.film.x, a.film.y - b.film.y) < near;
           });
  }));
}

TEST(PointImages, OfOneThousandStarsBehindThreeMassesAreThoseOfABruteForceGrid) {
  const Scene scene = three_masses();
  const double step = 0.25, least = 0.01;
  const DirectionIndex stars(random_stars(scene, 1000, 1));
  const auto expected = images_of_grid(trace_grid(scene, step), stars, least);
  const auto found =
      find_point_images(tracer_of(scene), stars, {.margin_px = 0, .least_magnification = least});
  EXPECT_GT(found.size(), 1300U);
  EXPECT_EQ(without_partner(found, expected, 1.2 * least, 2 * step), 0);
  EXPECT_EQ(without_partner(expected, found, 1.2 * least, 2 * step), 0);
}

}  // namespace
}  // namespace lensplane
