// SPDX-License-Identifier: Apache-2.0
//
// The tracer: Scene + Plan -> what any film position sees on every surface.
//
// Film positions come in batches; they may lie anywhere, not only at pixel centres. A ray's result depends on
// its film position alone, not on the batch it came in. One Tracer may be used from many threads.

#pragma once

#include <array>
#include <vector>

#include "src/plan.h"
#include "src/surfaces_batch.h"

namespace lensplane {

/// What a batch of rays meets on one surface; see SurfaceHit.
struct SurfaceBatch {
  alignas(64) BatchArray s, t, distance;
  std::array<Outcome, kBatchSize> outcome;
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
  void meet_spheres(const RayBatch& rays, double end_z, TraceBatch& batch) const;
  void meet_infinity(const RayBatch& rays, TraceBatch& batch) const;
  void trace_singly(int i, TraceBatch& batch) const;

  Camera camera_;
  Plan plan_;
  std::vector<Surface> surfaces_;
};

}  // namespace lensplane
