// SPDX-License-Identifier: Apache-2.0
//
// One ray through the lens planes, step by step as the paper describes it: the readable reference for the
// batches of march_batch.h, and what traces the rare rays that they leave aside.
//
// A ray runs straight to the nearest plane ahead of it, is bent there by each source in turn, and goes on in
// the direction it then has. All positions are in camera axes, in metres.

#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "src/lens_planes.h"

namespace lensplane {

/// A straight stretch of a ray.
struct RaySegment {
  Vec3 start;                                               // metres
  Vec3 direction;                                           // unit vector
  double length = std::numeric_limits<double>::infinity();  // metres
};

/// A ray from the camera to where it ends or leaves.
struct RayPath {
  std::vector<RaySegment> segments;  // never empty; the last one is infinite unless the ray is captured
  bool captured = false;             // it met a source exactly, or found no way out between the planes
};

/// A ray that has crossed planes this often, to and fro, is taken to be captured.
inline constexpr int kMaxCrossings = 1000;

/// The direction of a ray along the unit vector `direction` after it passes a source of geometric mass `m`
/// that lies at `to_source` = P_g - Q from its crossing point Q. Equations (1) to (6); for alpha > 90 deg,
/// where (5) and (6) would point the wrong way, the rotation by alpha that they are below. Nothing when the
/// source bends the ray in no definite direction: Q on the source, or the source straight ahead; the ray is
/// captured.
std::optional<Vec3> bend(const Vec3& direction, const Vec3& to_source, double m);

/// The path of the ray from `start` along the unit vector `direction` through `planes` (as lens_planes orders
/// them). A plane that contains `start` is not crossed there.
RayPath march(const std::vector<LensPlane>& planes, const Vec3& start, const Vec3& direction);

}  // namespace lensplane
