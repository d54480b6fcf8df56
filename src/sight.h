// SPDX-License-Identifier: Apache-2.0
//
// From rays to results: what rays on their way meet on each surface, written to a SurfaceBatch with the
// passes that are called for.

#pragma once

#include <vector>

#include "src/effects.h"
#include "src/surfaces_batch.h"

namespace lensplane {

/// A batch of film positions, in, and what they see, out.
struct TraceBatch {
  alignas(64) BatchArray x{}, y{};    // pixels; all kBatchSize must be finite
  alignas(64) BatchArray captured{};  // out: 1 where the light ends in a mass, whatever it met before, else 0
  std::vector<SurfaceBatch> surfaces;  // in the order of Scene::surfaces; where not Hit, s = t = 0
};

/// What there is to see, and what is asked of it.
struct Sight {
  const Camera& camera;
  const std::vector<Surface>& surfaces;  // in camera axes
  const Effects& effects;
  double slope = 0;                    // slope_per_pixel() of a perspective camera
  const Deflectors* finite = nullptr;  // the masses, when their finite distance from surfaces counts
  bool bodies = true;                  // are they looked for?

  bool any_body() const;
};

/// A batch with room for what is asked; nothing is met yet.
TraceBatch make_batch(const Sight& sight);

/// How many of the first `count` rays were given up.
int unresolved_rays(const TraceBatch& batch, std::size_t count);

/// Sets the bodies to nothing met: what lies at infinity is written for every ray.
void clear_bodies(const Sight& sight, TraceBatch& batch);

/// Writes one ray's result on one surface.
template <class Number>
void set(const Sight& sight, const SurfaceHit<Number>& hit, int i, SurfaceBatch& surface);

/// What one ray meets on each surface, in their order.
template <class Number>
struct RayHits {
  std::vector<SurfaceHit<Number>> hits;
  bool captured = false;  // it ends in a mass, whatever it met before
};

/// Writes one ray's results, on all surfaces.
template <class Number>
void set(const Sight& sight, const RayHits<Number>& ray, int i, TraceBatch& batch);

/// Copies one ray's results, on all surfaces.
void copy_ray(const TraceBatch& from, int i, TraceBatch& to, int k);

/// Copies one ray's results on bodies alone.
void copy_bodies(const std::vector<Surface>& surfaces, const TraceBatch& from, int i, TraceBatch& to, int k);

/// A stretch of a ray between planes, or a chord of its way round the masses of one.
enum class Stretch { Straight, Chord };

/// Lets the rays meet the bodies on their present stretch. Rays for which that does not do are marked
/// irregular where they hit: those whose arrival time is asked for, because a batch does not keep the masses
/// that they passed, and those with derivatives that hit on a chord, because a batch does not keep the
/// derivatives along a stretch of where it starts.
template <class Number>
void see_bodies(const Sight& sight, const Ends& ends, int bends, Stretch stretch, LineBatch<Number>& rays,
                TraceBatch& batch);

/// Lets the rays meet what lies at infinity, or end in their masses. `bends`: how many planes bent them.
template <class Number>
void see_infinity(const Sight& sight, const LineBatch<Number>& rays, int bends, TraceBatch& batch);

}  // namespace lensplane
