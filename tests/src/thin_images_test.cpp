// SPDX-License-Identifier: Apache-2.0
//
// Thin images against the lens equation: how many pixels they cover, wherever they are.

#include "src/thin_images.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "tests/src/scenes.h"

namespace lensplane {
namespace {

// Of the area of all images of a sphere. A twentieth of a pixel is a few hundredths of a step of the search.
constexpr double kAreaError = 0.02;

/// A mass whose Einstein ring has a radius of `einstein` pixels, off the middle of a pixel, half way to a
/// sphere of `radius` pixels that is `beta` Einstein radii beside it.
Scene lensed_scene(double einstein, double beta, double radius, int place) {
  Scene scene;
  scene.camera.width = scene.camera.height = 64;
  scene.camera.fov_rad = 1e-4;
  const double pixel = slope_per_pixel(scene.camera), distance = 1e9;
  const double x = std::fmod(place * 0.618, 1.0), y = place / 8.0, angle = place * 0.7;
  const double angle_e = einstein * pixel;
  scene.lenses = {{angle_e * angle_e * distance / 2, Vec3(x * pixel, y * pixel, -1) * distance}};
  const Vec3 beside(beta * einstein * std::cos(angle), beta * einstein * std::sin(angle), 0);
  scene.surfaces = {Sphere{(Vec3(x, y, 0) + beside) * (pixel * 2 * distance) - Vec3(0, 0, 2 * distance),
                           radius * pixel * 2 * distance,
                           {}}};
  return scene;
}

/// Pixels that a disc covers, by the lens equation of a point mass.
double area_by_lens_equation(double einstein, double beta, double radius) {
  if (beta == 0) return kPi * radius * std::sqrt(radius * radius + 4 * einstein * einstein);
  double sum = 0;
  constexpr int kPoints = 120;
  for (int n = 0; n < kPoints * kPoints; ++n) {
    const double rho = radius * std::sqrt((n % kPoints + 0.5) / kPoints);
    const double turn = 2 * kPi * (n / kPoints + 0.5) / kPoints;
    const double u = std::hypot(beta + rho / einstein * std::cos(turn), rho / einstein * std::sin(turn));
    sum += (u * u + 2) / (u * std::sqrt(u * u + 4));
  }
  return sum / (kPoints * kPoints) * kPi * radius * radius;
}

double area_of(const std::vector<ThinImage>& images) {
  double sum = 0;
  for (const ThinImage& thin : images) {
    for (const ImageRay& ray : rays_over(thin.image, thin.square)) sum += ray.area;
  }
  return sum;
}

Tracer tracer_of(const Scene& scene, Method method) {
  return exact_enough_for_thin(Tracer(scene, plan_trace(scene, method)));
}

TEST(ThinImages, HaveTheAreasOfTheLensEquation) {
  for (const double einstein : {2.0, 8.0}) {
    for (const double beta : {0.0, 0.05, 0.3, 1.0, 2.0}) {
      for (const double radius : {0.05, 0.3}) {
        const double expected = area_by_lens_equation(einstein, beta, radius);
        for (int place = 0; place < 8; ++place) {
          for (const Method method : {Method::Planes, Method::Kishi, Method::Geodesic}) {
            if (method == Method::Geodesic && place % 4 != 1) continue;
            const Scene scene = lensed_scene(einstein, beta, radius, place);
            EXPECT_NEAR(area_of(find_thin_images(tracer_of(scene, method), 0)) / expected, 1, kAreaError)
                << einstein << ' ' << beta << ' ' << radius << ' ' << place << ' '
                << static_cast<int>(method);
          }
        }
      }
    }
  }
}

TEST(ThinImages, LieInSquaresOfTheirOwn) {
  const std::vector<ThinImage> images =
      find_thin_images(tracer_of(lensed_scene(8, 0.05, 0.3, 3), Method::Planes), 0);
  ASSERT_GT(images.size(), 20U);
  for (std::size_t a = 0; a < images.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      EXPECT_FALSE(images[a].square.holds(images[b].square.centre()) ||
                   images[b].square.holds(images[a].square.centre()));
    }
  }
}

TEST(ThinImages, AreNoneOfWhatIsWideOrElsewhere) {
  Scene scene = lensed_scene(0, 0, 20, 0);
  EXPECT_TRUE(find_thin_images(tracer_of(scene, Method::Planes), 2).empty());
  std::get<Sphere>(scene.surfaces[0]).centre.z *= -1;  // behind the camera
  EXPECT_TRUE(find_thin_images(tracer_of(scene, Method::Planes), 2).empty());
  scene.surfaces = {Plate{}, LatLong{}, Card{1e9}};
  EXPECT_TRUE(find_thin_images(tracer_of(scene, Method::Planes), 2).empty());
}

TEST(ThinImages, DoNotDependOnTheNumberOfThreads) {
  const Scene scene = seed_fig6(200);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return find_thin_images(tracer_of(scene, Method::Planes), 2);
  };
  const auto one = with(1), two = with(2);
  ASSERT_EQ(one.size(), two.size());
  EXPECT_GT(one.size(), 0U);  // of the Earth, close to the masses
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].square.corner.x, two[i].square.corner.x);
    EXPECT_EQ(one[i].image.u, two[i].image.u);
  }
}

}  // namespace
}  // namespace lensplane
