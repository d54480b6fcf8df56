// SPDX-License-Identifier: Apache-2.0
//
// Many rays at once by the paper's methods: the fast path of march.h, for planes parallel to the screen.
//
// The steps are those of march.h, each for a whole batch. A ray for which the loops would not do (a bend
// beyond kBatchAlpha, a source met exactly, a turn away from the screen) is marked irregular; its numbers
// mean nothing and march() has to trace it.

#pragma once

#include "src/lens_planes.h"
#include "src/line_batch.h"

namespace lensplane {

/// Largest single bend, in radians, that the batches do themselves.
inline constexpr double kBatchAlpha = 0.5;

/// Batches and march() agree on the direction, per bend, to this angle in radians.
inline constexpr double kBatchError = 1e-15;

/// Moves every ray on to the plane at `distance` along -z, which is farther from the camera.
void advance_rays(double distance, LineBatch<double>& rays);

/// Bends every ray by a source on the plane where the rays are.
void bend_rays(const Source& source, LineBatch<double>& rays);

}  // namespace lensplane
