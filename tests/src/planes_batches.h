// SPDX-License-Identifier: Apache-2.0
//
// Scenes for tests of the kernels of `planes`, and batches that have passed their planes.

#pragma once

#include <cmath>
#include <memory>
#include <random>

#include "src/exact_law.h"
#include "src/planes_batch.h"
#include "tests/src/deflector_scenes.h"
#include "tests/src/film.h"

namespace lensplane {

inline constexpr PlanesWork kFarWork{Reach::Far, true, false}, kNearWork{Reach::Near, true, false};

/// `planes` times `masses` masses of about `m` each: on planes before a perspective camera, or anywhere round
/// a lat-long camera.
inline Scene random_scene(std::mt19937& random, Projection projection, int planes, int masses, double m) {
  std::normal_distribution<double> normal;
  Scene scene;
  scene.camera = test_camera(0.5);
  scene.camera.projection = projection;
  for (int k = 1; k <= planes; ++k) {
    for (int s = 0; s < masses; ++s) {
      const double z = projection == Projection::Perspective ? -50.0 * k : 40.0 * normal(random);
      const Vec3 position(10.0 * k * normal(random), 6.0 * k * normal(random), z);
      scene.lenses.push_back({m * std::exp(0.3 * normal(random)), position});
    }
  }
  return scene;
}

template <class Number>
std::unique_ptr<LineBatch<Number>> passed(const Camera& camera, const Deflectors& deflectors,
                                          const PlanesWork& work, const Film& film) {
  auto rays = std::make_unique<LineBatch<Number>>();
  start_lines(camera, slope_per_pixel(camera), film.x, film.y, true, *rays);
  for (std::size_t k = 0; k < deflectors.outward; ++k) pass_plane(deflectors, k, work, *rays);
  return rays;
}

}  // namespace lensplane
