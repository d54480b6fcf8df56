// SPDX-License-Identifier: Apache-2.0
//
// Many rays at once through the lens planes: the fast path of march.h.
//
// Rays lie in arrays of a fixed size, so that each step is a plain loop without branches which the compiler
// turns into vector instructions, for several instruction sets in one binary. Only additions,
// multiplications, divisions and square roots are used, none of them contracted: every instruction set gives
// the same bits, and a ray's result does not depend on its neighbours. A ray for which the loops would not do
// (a bend beyond kBatchAlpha, a source met exactly, a turn away from the screen) is marked irregular; its
// numbers mean nothing and march() has to trace it.

#pragma once

#include "src/lens_planes.h"
#include "src/projection.h"

namespace lensplane {

inline constexpr int kBatchSize = 256;

/// Largest single bend, in radians, that the batches do themselves.
inline constexpr double kBatchAlpha = 0.5;

/// Batches and march() agree on the direction, per bend, to this angle in radians.
inline constexpr double kBatchError = 1e-15;

using BatchArray = double[kBatchSize];

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

/// For each ray the distance from its start at which it enters the ball, infinite when it does not before the
/// plane z = `end_z` (which may be -infinity).
void enter_sphere(const Vec3& centre, double radius, double end_z, const RayBatch& rays, BatchArray& entry);

/// For each ray that left the camera through (x[i], y[i]) the (s, t) of the plate at infinity in its present
/// direction; `in_front` is 1, or 0 where no position on the plate corresponds to the direction and s, t mean
/// nothing.
void meet_plate(const Camera& camera, const BatchArray& x, const BatchArray& y, const RayBatch& rays,
                BatchArray& s, BatchArray& t, BatchArray& in_front);

}  // namespace lensplane
