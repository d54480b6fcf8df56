// SPDX-License-Identifier: Apache-2.0
//
// Scenes of a few masses for tests of the method `planes`, and shorthands for its numbers.

#pragma once

#include <vector>

#include "src/constants.h"
#include "src/deflectors.h"

namespace lensplane {

inline Scene scene_of(Projection projection, std::vector<Lens> lenses) {
  Scene scene;
  scene.camera.width = scene.camera.height = 100;
  scene.camera.fov_rad = 1.0;
  scene.camera.projection = projection;
  scene.lenses = std::move(lenses);
  return scene;
}

/// Deflectors of masses before a perspective camera at the origin.
inline Deflectors flat_deflectors(const std::vector<Lens>& lenses, Law law, bool finite_distance = false) {
  return deflectors_of(scene_of(Projection::Perspective, lenses), law, finite_distance);
}

/// Deflectors of masses round a lat-long camera at the origin.
inline Deflectors round_deflectors(const std::vector<Lens>& lenses, Law law) {
  return deflectors_of(scene_of(Projection::LatLong, lenses), law, true);
}

/// The unit vector at `angle` from -z, towards +x.
inline Vec3 at_angle(double angle) {
  return {std::sin(angle), 0, -std::cos(angle)};
}

/// Distance rho of the isotropic metric at Schwarzschild's r, in units of m.
inline double isotropic_radius(double r) {
  return (r - 1 + std::sqrt(r * r - 2 * r)) / 2;
}

}  // namespace lensplane
