// SPDX-License-Identifier: Apache-2.0
//
// A camera and random film positions for tests of batches.

#pragma once

#include <random>

#include "src/batch.h"
#include "src/scene.h"

namespace lensplane {

struct Film {
  alignas(64) BatchArray x, y;
};

inline Camera test_camera(double fov_rad) {
  Camera camera;
  camera.width = 1920;
  camera.height = 1080;
  camera.fov_rad = fov_rad;
  return camera;
}

inline void random_film(std::mt19937& random, const Camera& camera, Film& film) {
  std::uniform_real_distribution<double> x(0, camera.width), y(0, camera.height);
  for (int i = 0; i < kBatchSize; ++i) film.x[i] = x(random), film.y[i] = y(random);
}

}  // namespace lensplane
