// SPDX-License-Identifier: Apache-2.0
//
// What the benchmarks look at.

#pragma once

#include "src/constants.h"
#include "src/scene.h"

namespace lensplane {

/// The paper's Fig. 6: three sources at three depths, not in a line, before a surface.
inline Scene fig6(int width, int height, const Surface& surface = Plate{}) {
  Scene scene;
  scene.camera.width = width;
  scene.camera.height = height;
  scene.camera.fov_rad = 3.0 * kPi / 180.0;
  const double m = geometric_mass_from_kg(1.989e31);
  const double side = 5.95e6;
  scene.lenses = {{m, {-side, -0.5 * side, -0.4 * 1.09e9}},
                  {m, {side, -0.4 * side, -0.5 * 1.09e9}},
                  {m, {0.1 * side, 0.9 * side, -0.6 * 1.09e9}}};
  scene.surfaces = {surface};
  return scene;
}

}  // namespace lensplane
