// SPDX-License-Identifier: Apache-2.0
//
// Lens planes: the masses of a scene, sorted into planes parallel to the screen.
//
// Everything here is in camera axes, relative to the camera: a plane in front of it has z < 0. Masses of zero
// are left out, so that they change nothing, bit for bit.

#pragma once

#include <vector>

#include "src/method.h"
#include "src/scene.h"

namespace lensplane {

/// A point mass on a lens plane.
struct Source {
  double m;     // geometric mass, metres, > 0
  double x, y;  // metres, camera axes
};

/// A plane z = const and its sources, in the order in which the scene lists them: rays are bent in this
/// order.
struct LensPlane {
  double z;  // metres, camera axes
  std::vector<Source> sources;
};

/// Sources whose depths differ by no more than this share of their distance from the camera stand on one
/// plane: turning a plane of sources from world to camera axes rounds their depths by less.
inline constexpr double kEqualDepth = 1e-12;

/// The planes of `scene` by `method`, from the nearest in front of the camera to the farthest, preceded by
/// those behind and beside it (which only light that has turned back can reach). By Kishi's method there is
/// one plane: the sources in front of the camera, moved along its axis to their mass-weighted mean depth.
/// Sources beside and behind the camera do not count there.
std::vector<LensPlane> lens_planes(const Scene& scene, Method method);

}  // namespace lensplane
