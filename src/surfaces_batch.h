// SPDX-License-Identifier: Apache-2.0
//
// Where batches of rays meet surfaces: the fast path of surfaces.h.

#pragma once

#include "src/march_batch.h"
#include "src/surfaces.h"

namespace lensplane {

/// For each ray the distance from its start at which it enters the ball, infinite when it does not before the
/// plane z = `end_z` (which may be -infinity).
void enter_sphere(const Vec3& centre, double radius, double end_z, const RayBatch& rays, BatchArray& entry);

/// For each ray that left the camera through (x[i], y[i]) the (s, t) of the plate at infinity in its present
/// direction; `in_front` is 1, or 0 where no position on the plate corresponds to the direction and s, t mean
/// nothing.
void meet_plate(const Camera& camera, const BatchArray& x, const BatchArray& y, const RayBatch& rays,
                BatchArray& s, BatchArray& t, BatchArray& in_front);

}  // namespace lensplane
