// SPDX-License-Identifier: Apache-2.0
//
// The finite distance of a light source for batches: finite_shift.h as plain loops over rays.

#pragma once

#include "src/deflectors.h"
#include "src/surfaces_batch.h"

namespace lensplane {

/// Straight stretches as they truly run at a ball, bit for bit as shifted_to_ball() has them. `bends`: planes
/// that have bent them so far.
template <class Number>
void shift_to_ball(const Deflectors& deflectors, const Sphere& sphere, const Ends& ends, int bends,
                   VectorLane<Number>& start, VectorLane<Number>& direction);

}  // namespace lensplane
