// SPDX-License-Identifier: Apache-2.0
//
// Many rays at once through the lens planes: the fast path of march.h.
//
// The steps are those of march.h, each for a whole batch. A ray for which the loops would not do (a bend
// beyond kBatchAlpha, a source met exactly, a turn away from the screen) is marked irregular; its numbers
// mean nothing and march() has to trace it.

#pragma once

#include "src/batch.h"
#include "src/lens_planes.h"
#include "src/projection.h"

namespace lensplane {

/// Largest single bend, in radians, that the batches do themselves.
inline constexpr double kBatchAlpha = 0.5;

/// Batches and march() agree on the direction, per bend, to this angle in radians.
inline constexpr double kBatchError = 1e-15;

/// The present straight stretch of each ray, in camera axes and metres.
struct RayBatch {
  alignas(64) BatchArray start_x, start_y;       // where it starts
  alignas(64) BatchArray dir_x, dir_y, dir_z;    // its unit direction
  alignas(64) BatchArray travelled;              // length of the path up to there
  alignas(64) BatchArray first_right, first_up;  // slopes of the direction at the camera
  alignas(64) BatchArray irregular;              // 0, or 1 when march() has to trace this ray
  double start_z;                                // all rays stand on one plane
};

/// Rays from the camera through the film positions (x[i], y[i]).
void start_rays(const Camera& camera, const BatchArray& x, const BatchArray& y, RayBatch& rays);

/// Moves every ray on to the plane z = `z`, which is farther from the camera.
void advance_rays(double z, RayBatch& rays);

/// Bends every ray by a source on the plane where the rays are.
void bend_rays(const Source& source, RayBatch& rays);

}  // namespace lensplane
