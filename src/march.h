// SPDX-License-Identifier: Apache-2.0
//
// The paper's methods, a ray at a time, step by step as the paper describes them: the readable reference for
// the batches of march_batch.h, and what traces the rays that they leave aside.
//
// A ray runs straight to the nearest plane ahead of it, is bent there by each source in turn, and goes on in
// the direction it then has. All positions are in camera axes, in metres. Templates over the number type are
// instantiated for `double` and for `Dual`.

#pragma once

#include <optional>
#include <vector>

#include "src/lens_planes.h"
#include "src/ray_path.h"

namespace lensplane {

/// The direction of a ray along the unit vector `direction` after it passes a source of geometric mass `m`
/// that lies at `to_source` = P_g - Q from its crossing point Q. Equations (1) to (6); for alpha > 90 deg,
/// where (5) and (6) would point the wrong way, the rotation by alpha that they are below. Nothing when the
/// source bends the ray in no definite direction: Q on the source, or the source straight ahead; the ray is
/// captured.
template <class Number>
std::optional<Vector<Number>> bend(const Vector<Number>& direction, const Vector<Number>& to_source,
                                   double m);

/// The path of the ray from `start` along the unit vector `direction` through `planes` (as lens_planes orders
/// them). A plane that contains `start` is not crossed there. Planes that are not parallel are crossed once,
/// on the way out, and only by rays that come nearer to their source: to others they have no distance.
template <class Number>
RayPath<Number> march(const std::vector<LensPlane>& planes, const Vector<Number>& start,
                      const Vector<Number>& direction);

}  // namespace lensplane
