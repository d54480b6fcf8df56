// SPDX-License-Identifier: Apache-2.0
//
// Light where it passes bodies, against where rays meet them, by every method.

#include "src/passing_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "src/body_image.h"
#include "tests/src/scenes.h"

namespace lensplane {
namespace {

/// The paper's three masses before something of a third of the Earth's size.
Tracer tracer_of(const Surface& body, Method method) {
  Scene scene = seed_fig6(200);
  scene.surfaces = {body};
  TraceSettings settings;
  settings.method = method;
  settings.effects.jacobian = true;
  return {scene, plan_trace(scene, settings)};
}

constexpr double kSize = kSeedEarthRadius / 3;
const Vec3 kPlace(2e6, -1.5e6, -kSeedDistance);
const Basis kTilted{{1, 0, 0}, {0, 0.6, 0.8}, {0, -0.8, 0.6}};
const Method kMethods[] = {Method::Planes, Method::Kishi, Method::ShinotsukaMakino, Method::Geodesic};

/// Whether the rays of a row of the film meet the body.
std::vector<bool> hits_along(const Tracer& tracer, double y, std::vector<FilmPosition>& films) {
  TraceBatch batch = tracer.make_batch();
  std::vector<bool> hits;
  films.clear();
  for (int first = 0; first < 5 * kBatchSize; first += kBatchSize) {
    for (int i = 0; i < kBatchSize; ++i) {
      batch.x[i] = 200.0 * (first + i + 0.5) / (5 * kBatchSize), batch.y[i] = y;
      films.push_back({batch.x[i], y});
    }
    tracer.trace(batch);
    for (std::size_t i = 0; i < kBatchSize; ++i) hits.push_back(batch.surfaces[0].outcome[i] == Outcome::Hit);
  }
  return hits;
}

TEST(PassingLight, IsOnABodyWhereRaysMeetIt) {
  const Surface bodies[] = {Sphere{kPlace, kSize, {}}, Ring{kPlace, kTilted, 0.7 * kSize, kSize}};
  for (const Surface& body : bodies) {
    for (const Method method : kMethods) {
      const Tracer tracer = tracer_of(body, method);
      int met = 0, wrong = 0, all = 0;
      for (double y = 60; y < 160; y += 3.7) {
        std::vector<FilmPosition> films;
        const std::vector<bool> hits = hits_along(tracer, y, films);
        const PassingLight light(tracer, films);
        for (std::size_t i = 0; i < hits.size(); ++i) {
          const auto line = light.past(i, 0);
          const auto image = line ? body_image(tracer.surfaces()[0], *line, films[i]) : std::nullopt;
          met += hits[i], ++all;
          wrong += hits[i] != (image && image->holds(films[i]));
        }
      }
      EXPECT_GT(met, 100);
      EXPECT_LE(wrong, all / 2000) << static_cast<int>(method) << ' ' << body.index();  // those that graze it
    }
  }
}

TEST(PassingLight, MovesWithTheFilmAsItsDerivativesSay) {
  for (const Method method : kMethods) {
    const Tracer tracer = tracer_of(Sphere{kPlace, kSize, {}}, method);
    for (const FilmPosition film : {FilmPosition{95.3, 88.1}, {20.5, 30.5}, {130.2, 96.4}}) {
      constexpr double kStep = 1e-3;
      const std::vector<FilmPosition> films = {film, {film.x + kStep, film.y}, {film.x, film.y + kStep}};
      const PassingLight light(tracer, films);
      const auto image = body_image(tracer.surfaces()[0], *light.past(0, 0), film);
      for (const std::size_t i : {1U, 2U}) {
        const auto there = body_image(tracer.surfaces()[0], *light.past(i, 0), films[i]);
        EXPECT_LT(apart(*image, *there, films[i]), 2e-3 * kStep) << static_cast<int>(method) << ' ' << film.x;
      }
    }
  }
}

TEST(PassingLight, KnowsHowFarMassesAre) {
  Scene scene;
  scene.camera.width = scene.camera.height = 100;
  scene.camera.fov_rad = 0.01;
  scene.lenses = {{1.0, {0, 0, -1e6}}};
  scene.surfaces = {Sphere{{0, 0, -2e6}, 1, {}}};
  for (const Method method : {Method::Planes, Method::Geodesic}) {
    const Tracer tracer(scene, plan_trace(scene, method));
    const FilmPosition film{70, 50};
    const double angle = 20 * slope_per_pixel(scene.camera);
    const PassingLight light(tracer, {&film, 1});
    EXPECT_NEAR(light.clear_of_masses(0, 1e-9) / angle, 1, 1e-3);
    EXPECT_GT(light.clear_of_masses(0, 1e-2), 1e9);  // it bends by 2e-3
  }
}

TEST(PassingLight, FindsTheNearestPointOfARing) {
  for (const double tilt : {1.5, 0.7, 0.1, 1e-3}) {
    const Vec3 normal(0, std::cos(tilt), std::sin(tilt));
    const Ring ring{{0, 0, -100}, {{1, 0, 0}, normal, Vec3(1, 0, 0).cross(normal)}, 3, 5};
    for (const Vec3& through :
         {Vec3(7, 1, -100), Vec3(0.5, 0.1, -100), Vec3(4, 0.3, -100), Vec3(-2, 3, -100)}) {
      const Vec3 direction = through / length(through);
      double least = 1e9;
      for (int n = 0; n < 200000; ++n) {
        const double angle = 2 * kPi * n / 1000, radius = 3 + 2.0 * (n / 1000) / 199;
        const Vec3 point =
            ring.centre + (ring.axes.x * std::cos(angle) + ring.axes.z * std::sin(angle)) * radius;
        least = std::min(least, length(point - direction * point.dot(direction)));
      }
      const NearestPoint nearest = nearest_point(ring, Vec3(0), direction, 1e9);
      const double gap = length(direction * nearest.way - nearest.of_body);
      EXPECT_LT(gap, 1.3 * least + 0.03) << tilt << ' ' << through.x;  // "about as near as any"
      EXPECT_GT(gap, least - 0.03);
    }
  }
}

}  // namespace
}  // namespace lensplane
