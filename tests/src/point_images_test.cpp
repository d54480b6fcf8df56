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
constexpr double kRadius = 40;      // the same in pixels
constexpr double kMiddle = 128;     // of the film, pixels

/// The world direction that a camera at rest sees at `film` without masses.
Vec3 direction_at(const Scene& scene, FilmPosition film) {
  return scene.camera.axes.parent_from_local(direction_from_film<double>(scene.camera, film));
}

/// A mass in the middle of the film.
Scene point_lens() {
  Scene scene;
  scene.camera.width = scene.camera.height = static_cast<int>(2 * kMiddle);
  scene.camera.fov_rad = 2 * kMiddle / kRadius * kEinstein;
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
      const double x = kRadius * u * std::cos(turn), y = kRadius * u * std::sin(turn);
      const auto images = images_of(scene, {direction_at(scene, {kMiddle + x, kMiddle + y})});
      ASSERT_EQ(images.size(), 2U) << u << " " << turn;
      EXPECT_NEAR(total(images), amplification(u), 1e-5 * amplification(u)) << u;
      for (const PointImage& image : images) {
        const double along = (u + std::copysign(std::sqrt(u * u + 4), image.magnification)) / 2;
        EXPECT_NEAR(image.film.x, kMiddle + along / u * x, 1e-5) << u;
        EXPECT_NEAR(image.film.y, kMiddle + along / u * y, 1e-5) << u;
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
      scene.camera.fov_rad = 2 * kMiddle / pixels * kEinstein;
      const FilmPosition mass{kMiddle + place(random), kMiddle + place(random)};
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
  const auto images = images_of(scene, {direction_at(scene, {kMiddle, kMiddle})});
  EXPECT_GT(images.size(), 2U);
  EXPECT_NEAR(total(images), 1e4, 1e-6);
}

TEST(PointImages, TooFaintOnesAreLeftOut) {
  const Scene scene = point_lens();
  const Vec3 star = direction_at(scene, {kMiddle + 2 * kRadius, kMiddle});
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
    for (const std::size_t i : stars.within({a.direction, reach})) {
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

/// Compares the images of `stars` with brute force, both ways.
void expect_all_images(const Scene& scene, const DirectionIndex& stars, std::size_t at_least) {
  const double step = 0.25, least = 0.01;
  const auto expected = images_of_grid(trace_grid(scene, step), stars, least);
  const auto found =
      find_point_images(tracer_of(scene), stars, {.margin_px = 0, .least_magnification = least});
  EXPECT_GT(found.size(), at_least);
  EXPECT_EQ(without_partner(found, expected, 1.2 * least, 2 * step), 0);
  EXPECT_EQ(without_partner(expected, found, 1.2 * least, 2 * step), 0);
}

TEST(PointImages, OfOneThousandStarsBehindThreeMassesAreThoseOfABruteForceGrid) {
  const Scene scene = three_masses();
  expect_all_images(scene, DirectionIndex(random_stars(scene, 1000, 1)), 1300);
}

TEST(PointImages, RoundASmallMassThatALargeOneShowsElsewhereAreAllFound) {
  Scene scene = three_masses();
  const double pixel = kEinstein / 100 * kDistance;
  scene.lenses[1] = {scene.lenses[0].m / 100, {-40 * pixel, 70 * pixel, -2 * kDistance}};
  scene.lenses.pop_back();
  expect_all_images(scene, DirectionIndex(random_stars(scene, 3000, 6)), 2000);
}

TEST(PointImages, OnTheEdgesOfCellsAreFoundOnce) {
  Scene scene = point_lens();
  scene.lenses = {{1e-30, {0.3, 0.2, -1}}};  // moves nothing
  std::mt19937 random(7);
  std::uniform_int_distribution<int> cell(1, 30);
  std::uniform_real_distribution<double> y(0, 2 * kMiddle);
  std::vector<Vec3> stars;
  for (int i = 0; i < 500; ++i) stars.push_back(direction_at(scene, {8.0 * cell(random), y(random)}));
  EXPECT_EQ(images_of(scene, stars, {.margin_px = 0}).size(), stars.size());
}

TEST(PointImages, OfASinglePlaneOfMassesAreOneMoreThanTheMassesOrAnEvenNumberMore) {
  // n point masses on one plane have n + 1, n + 3, ... images, n - 1 more mirrored than not: no light goes
  // through the masses themselves, or every star would have one image more than is not mirrored.
  Scene scene = three_masses();
  for (Lens& lens : scene.lenses) lens.position *= kDistance / -lens.position.z;
  const std::vector<Vec3> stars = random_stars(scene, 200, 2);
  scene.camera.overscan = 400;  // no image is off the film
  const auto images = images_of(scene, stars, {.least_magnification = 1e-7});
  std::vector<int> count(stars.size()), parity(stars.size());
  for (const PointImage& image : images) {
    ++count[image.point];
    parity[image.point] += image.magnification > 0 ? 1 : -1;
  }
  for (std::size_t i = 0; i < stars.size(); ++i) {
    EXPECT_GE(count[i], 4) << i;
    EXPECT_EQ(count[i] % 2, 0) << i;
    EXPECT_EQ(parity[i], 1 - 3) << i;
  }
}

/// The same scene with a mass so small that it moves nothing: images are found in cells.
Scene with_nothing(Scene scene) {
  scene.lenses = {{1e-30, {0.3, 0.2, -1}}};
  return scene;
}

std::vector<Vec3> stars_everywhere(int count) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vec3> stars = {{0, 0, -1}, {0, 1, 0}, {0, -1, 0},
                             {0, 0, 1},  {1, 0, 0}, Vec3(1e-4, 1, 1e-4).normalized()};
  for (int i = 0; i < count; ++i)
    stars.push_back(Vec3(normal(random), normal(random), normal(random)).normalized());
  return stars;
}

TEST(PointImages, WithoutMassesAreWhereTheProjectionPutsThemWithOrWithoutCells) {
  const std::vector<Vec3> stars = stars_everywhere(300);
  for (const Projection projection : {Projection::Perspective, Projection::LatLong, Projection::Fisheye}) {
    for (const Vec3& turn : {Vec3(0, 0, 0), Vec3(0.9, 2, 0.3)}) {
      Scene scene;
      scene.camera.width = 200;
      scene.camera.height = 100;
      scene.camera.overscan = 10;
      scene.camera.projection = projection;
      scene.camera.fov_rad = projection == Projection::Fisheye ? 6.2 : 2.0;
      scene.camera.axes = basis_from_zxy(turn);
      // Straight along the poles of a lat-long film every x is right.
      std::vector<Vec3> seen = stars;
      std::erase_if(seen, [&](const Vec3& star) {
        return projection == Projection::LatLong && std::abs(scene.camera.axes.y.dot(star)) > 1 - 1e-12;
      });
      const auto direct = images_of(scene, seen), by_cells = images_of(with_nothing(scene), seen);
      ASSERT_EQ(direct.size(), by_cells.size()) << static_cast<int>(projection);
      EXPECT_GT(direct.size(), 20U);
      EXPECT_EQ(without_partner(direct, by_cells, 0, 2 * kImageError), 0);
      for (std::size_t i = 0; i < direct.size(); ++i) {
        EXPECT_EQ(direct[i].magnification, 1);
        EXPECT_NEAR(by_cells[i].magnification, 1, 1e-9);
        const Vec3 looks = direction_at(scene, direct[i].film);
        EXPECT_LT((looks - seen[direct[i].point]).length(), 1e-12);
      }
    }
  }
}

TEST(PointImages, BehindAPerspectiveCameraAreNotSeen) {
  Scene scene = point_lens();
  const std::vector<Vec3> behind = {{0, 0, 1}, Vec3(1e-6, 0, 1).normalized(), {1, 0, 0}};
  EXPECT_TRUE(images_of(scene, behind).empty());
  scene.lenses.clear();
  EXPECT_TRUE(images_of(scene, behind).empty());
}

TEST(PointImages, ReachBeyondTheFrameByTheMargin) {
  for (const bool cells : {false, true}) {
    Scene scene = point_lens();
    scene.lenses.clear();
    const std::vector<Vec3> stars = {direction_at(scene, {-3, 100}), direction_at(scene, {100, 258})};
    if (cells) scene = with_nothing(scene);
    EXPECT_EQ(images_of(scene, stars, {.margin_px = 4}).size(), 2U);
    EXPECT_EQ(images_of(scene, stars, {.margin_px = 2.5}).size(), 1U);
    scene.camera.overscan = 3;
    EXPECT_EQ(images_of(scene, stars, {.margin_px = 0.5}).size(), 2U);
  }
}

TEST(PointImages, OfADriftingStarKeepItsAmplification) {
  // 200 places along a line that passes the mass at 0.3 Einstein radii, through cells and blocks.
  const Scene scene = point_lens();
  for (int i = 0; i < 200; ++i) {
    const double x = -80 + 0.807 * i, y = 12;
    const double expected = amplification(std::hypot(x, y) / kRadius);
    const auto images = images_of(scene, {direction_at(scene, {kMiddle + x, kMiddle + y})});
    EXPECT_NEAR(total(images), expected, 2e-4 * expected) << i;
  }
}

TEST(PointImages, AtAPoleOfALatLongFilmAreAsElsewhere) {
  Scene scene;
  scene.camera.width = 400;
  scene.camera.height = 200;
  scene.camera.projection = Projection::LatLong;
  const double einstein = 0.05, u = 0.6;
  for (const double polar : {0.0, 0.004, 0.03, 1.0}) {
    const Vec3 mass(std::sin(polar), std::cos(polar), 0);
    const Vec3 aside(std::cos(polar), -std::sin(polar), 0);
    scene.lenses = {{einstein * einstein / 4, mass}};
    const Vec3 star = (mass + u * einstein * aside + 1e-3 * Vec3(0, 0, 1)).normalized();
    const auto images = images_of(scene, {star}, {.margin_px = 0});
    ASSERT_EQ(images.size(), 2U) << polar;
    // Not small angles: u changes by their squares.
    EXPECT_NEAR(total(images), amplification(u), 0.01 * amplification(u)) << polar;
  }
}

TEST(PointImages, RoundABlackHoleAreThoseAlongTheLineThroughIt) {
  // A star's images lie on the great circle through the hole and the star: here the middle row.
  Scene scene;
  scene.camera.width = 1000;
  scene.camera.height = 400;
  scene.camera.fov_rad = 1.2;
  scene.lenses = {{1.0, {0, 0, -30}}};
  const Tracer tracer(scene,
                      plan_trace(scene, TraceSettings{Method::Planes, Law::Exact, 0.05, Choice::On, {}}));
  std::vector<FilmPosition> row;
  for (double x = 0; x <= 1000; x += 1.0 / 128) row.push_back({x, 200});
  const std::vector<SkyRay> rays = SkyRays(tracer).trace(row);
  const double least = 1e-4;
  int behind = 0;
  for (const double angle : {0.1, 0.5, 1.0, 2.0, 3.0, -0.3, -2.5}) {
    const Vec3 star(std::sin(angle), 0, -std::cos(angle));
    std::vector<FilmPosition> expected;
    for (std::size_t i = 1; i < rays.size(); ++i) {
      const SkyRay &a = rays[i - 1], &b = rays[i];
      if (!a.seen || !b.seen || std::abs(a.magnification) < least) continue;
      const bool between = (a.direction.cross(star).y >= 0) != (b.direction.cross(star).y >= 0);
      if (between && a.direction.dot(star) > 0) expected.push_back(a.film);
    }
    const auto images =
        find_point_images(tracer, DirectionIndex({star}), {.margin_px = 0, .least_magnification = least});
    ASSERT_EQ(images.size(), expected.size()) << angle;
    for (std::size_t i = 0; i < images.size(); ++i) {
      EXPECT_NEAR(images[i].film.y, 200, 1e-5);
      EXPECT_TRUE(std::any_of(expected.begin(), expected.end(), [&](FilmPosition film) {
        return std::abs(film.x - images[i].film.x) < 1.0 / 64;
      })) << angle;
    }
    if (std::abs(angle) > 0.6) behind += static_cast<int>(images.size());
  }
  EXPECT_GT(behind, 3);
}

TEST(PointImages, DoNotDependOnTheNumberOfThreads) {
  const Scene scene = three_masses();
  const DirectionIndex stars(random_stars(scene, 500, 4));
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return find_point_images(tracer_of(scene), stars);
  };
  const auto one = with(1), two = with(2), seven = with(7);
  ASSERT_EQ(one.size(), two.size());
  ASSERT_EQ(one.size(), seven.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (const auto* other : {&two, &seven}) {
      EXPECT_EQ(one[i].point, (*other)[i].point);
      EXPECT_EQ(one[i].film.x, (*other)[i].film.x);
      EXPECT_EQ(one[i].film.y, (*other)[i].film.y);
      EXPECT_EQ(one[i].magnification, (*other)[i].magnification);
    }
  }
}

}  // namespace
}  // namespace lensplane
