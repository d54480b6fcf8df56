// SPDX-License-Identifier: Apache-2.0
//
// Lens planes: the masses of a scene, sorted into planes.
//
// Everything here is in camera axes, relative to the camera. For a perspective camera the planes are parallel
// to its screen. Where there is no flat screen, each source has its own plane, perpendicular to its
// direction. Masses of zero are left out, so that they change nothing, bit for bit.

#pragma once

#include <cstddef>
#include <vector>

#include "src/method.h"
#include "src/scene.h"

namespace lensplane {

/// A point mass on a lens plane.
struct Source {
  double m;              // geometric mass, metres, > 0
  Vec3 position;         // metres, camera axes
  std::size_t lens = 0;  // its number in the scene
};

/// The plane normal . x = distance and its sources.
struct LensPlane {
  Vec3 normal;                  // unit vector, away from the camera: (0, 0, -1) for a flat screen
  double distance;              // metres; negative behind a flat screen's camera
  std::vector<Source> sources;  // in the order of the scene; by `planes`, in that of their positions
};

/// Sources whose depths differ by no more than this share of their distance from the camera stand on one
/// plane: turning a plane of sources from world to camera axes rounds their depths by less.
inline constexpr double kEqualDepth = 1e-12;

/// By `planes`, sources nearer to one another than this share of their joint geometric mass are one body, at
/// their centre of mass: what bends light then is their sum. Farther ones add up their bends.
inline constexpr double kOneBody = 1e-6;

/// So are sources nearer to one another than this share of their distance from the camera: turning them to
/// camera axes rounds their positions by up to as much.
inline constexpr double kOnePlace = 4e-15;

/// The planes of `scene` by `method`, by rising distance: those behind a flat screen's camera (which only
/// light that has turned back can reach) come first. By Kishi's method there is one plane: the sources in
/// front of the camera, moved along its axis to their mass-weighted mean depth; sources beside and behind the
/// camera do not count there, and without a flat screen each source keeps its own plane.
/// By `planes` the order of the sources in the scene has no influence: sources that are one body become one,
/// with the number of one of them, whatever plane they stand on, and bodies are sorted by their positions.
std::vector<LensPlane> lens_planes(const Scene& scene, Method method);

}  // namespace lensplane
