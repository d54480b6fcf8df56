// SPDX-License-Identifier: Apache-2.0
//
// The tracer: Scene + Plan -> what any film position sees on every surface.
//
// Film positions come in batches; they may lie anywhere, not only at pixel centres. A ray's result depends on
// its film position alone, not on the batch it came in. One Tracer may be used from many threads.

#pragma once

#include <array>
#include <memory>
#include <vector>

#include "src/batch.h"
#include "src/plan.h"
#include "src/surfaces.h"

namespace lensplane {

/// What a batch of rays meets on one surface beside (s, t); only what the plan's effects ask for is filled.
/// Where the surface is not hit: direction, shadow and bends of the ray as far as it goes, the rest 0.
struct PassBatch {
  alignas(64) BatchArray ds_dx, ds_dy, dt_dx, dt_dy;  // per pixel
  alignas(64) BatchArray magnification;               // signed; at most kLargestMagnification in size
  alignas(64) BatchArray delay;                       // seconds
  alignas(64) BatchArray dir_x, dir_y, dir_z;         // unit vector in the world
  alignas(64) BatchArray bends;                       // planes that bent the ray
};

/// What a batch of rays meets on one surface; see SurfaceHit.
struct SurfaceBatch {
  alignas(64) BatchArray s, t, distance;  // distance: metres along the bent ray, infinite for plates and skies
  std::array<Outcome, kBatchSize> outcome;
  std::unique_ptr<PassBatch> passes;  // null when no effect is called for
};

/// A batch of film positions, in, and what they see, out.
struct TraceBatch {
  alignas(64) BatchArray x{}, y{};     // pixels; all kBatchSize must be finite
  std::vector<SurfaceBatch> surfaces;  // in the order of Scene::surfaces; where not Hit, s = t = 0
};

class Tracer {
 public:
  Tracer(const Scene& scene, Plan plan);

  /// A batch with room for this tracer's surfaces, all film positions at the origin.
  TraceBatch make_batch() const;

  /// Traces the batch's film positions.
  void trace(TraceBatch& batch) const;

  const Camera& camera() const { return camera_; }
  const Plan& plan() const { return plan_; }
  const std::vector<Surface>& surfaces() const { return surfaces_; }  // in camera axes

 private:
  Camera camera_;
  Plan plan_;
  std::vector<Surface> surfaces_;
};

}  // namespace lensplane
