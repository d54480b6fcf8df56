// SPDX-License-Identifier: Apache-2.0
//
// Where batches of rays meet surfaces: the fast path of surfaces.h.

#pragma once

#include <array>
#include <memory>

#include "src/disc.h"
#include "src/line_batch.h"
#include "src/surfaces.h"

namespace lensplane {

/// What a batch of rays meets on one surface beside (s, t); only what the plan's effects ask for is filled.
/// Where the surface is not hit: direction, shadow and bends of the ray as far as it goes, the rest 0.
struct PassBatch {
  alignas(64) BatchArray ds_dx, ds_dy, dt_dx, dt_dy;  // per pixel
  alignas(64) BatchArray magnification;               // signed; at most kLargestMagnification in size
  alignas(64) BatchArray delay;                       // seconds after light in empty space
  alignas(64) BatchArray dir_x, dir_y, dir_z;         // unit vector in the world
  alignas(64) BatchArray bends;                       // planes that bent the ray
};

/// What a batch of rays meets on one surface; see SurfaceHit.
struct SurfaceBatch {
  alignas(64) BatchArray s, t,
      distance;  // distance: metres along the bent ray, infinite for skies and plates at infinity
  std::array<Outcome, kBatchSize> outcome;
  std::array<DiscPassage, kBatchSize> passages;  // of rings and cards: how far the rays have come
  std::unique_ptr<PassBatch> passes;             // null when no effect is called for
};

/// Where every straight stretch ends, in metres from its start.
struct Ends {
  alignas(64) BatchArray at;
};

/// At the closest approach to `point`; with `finite`, not before the start.
template <class Number>
void end_nearest(const Vec3& point, bool finite, const LineBatch<Number>& rays, Ends& ends);

/// At the plane at `distance` along -z.
void end_at_plane(double distance, const LineBatch<double>& rays, Ends& ends);

/// For each ray the distance from `start` at which it enters the ball, infinite when it does not before its
/// end.
template <class Number>
void enter_sphere(const Sphere& sphere, const VectorLane<Number>& start, const VectorLane<Number>& direction,
                  const Ends& ends, BatchArray& entry);

/// For each ray the side of a disc's plane on which its stretch ends, bit for bit as meet_disc() finds it
/// without finite distance; 0 where it stays on the side on which it began.
template <class Number>
void end_sides(const Disc& disc, const LineBatch<Number>& rays, const Ends& ends, BatchArray& sides);

/// (s, t) of a perspective camera's (`slope`: its slope_per_pixel()) plate at infinity for rays that left
/// through (x[i], y[i]) and were bent, outcomes, and with Dual numbers Jacobian and magnification into
/// `surface.passes`.
template <class Number>
void meet_plate(const Camera& camera, double slope, const BatchArray& x, const BatchArray& y,
                const LineBatch<Number>& rays, SurfaceBatch& surface);

}  // namespace lensplane
