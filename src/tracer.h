// SPDX-License-Identifier: Apache-2.0
//
// The tracer: Scene + Plan -> what any film position sees on every surface.
//
// Film positions come in batches; they may lie anywhere, not only at pixel centres. A ray's result depends on
// its film position alone, not on the batch it came in. One Tracer may be used from many threads.

#pragma once

#include <span>
#include <vector>

#include "src/plan.h"
#include "src/planes_batch.h"
#include "src/sight.h"

namespace lensplane {

class Tracer {
 public:
  Tracer(const Scene& scene, Plan plan);

  /// A batch with room for this tracer's surfaces, all film positions at the origin.
  TraceBatch make_batch() const;

  /// Traces the batch's film positions.
  void trace(TraceBatch& batch) const;

  /// Traces the same rays without any passes, which takes about a third of the time.
  Tracer without_passes() const;

  const Camera& camera() const { return camera_; }
  const Plan& plan() const { return plan_; }
  const std::vector<Surface>& surfaces() const { return surfaces_; }  // in camera axes

 private:
  Sight sight(const Deflectors* finite = nullptr, bool bodies = true) const;
  void trace_by_planes(TraceBatch& batch) const;
  void trace_by_recipe(std::size_t recipe, Reach reach, bool bodies, TraceBatch& batch) const;
  void trace_by_paper(TraceBatch& batch) const;
  std::vector<int> curved_rays(const TraceBatch& batch) const;
  void trace_curved(std::span<const int> rays, bool bodies_only, TraceBatch& batch) const;
  void trace_singly(std::size_t recipe, int i, TraceBatch& batch) const;

  Camera camera_;
  Plan plan_;
  std::vector<Surface> surfaces_;
  double slope_ = 0;  // slope_per_pixel() of a perspective camera
};

}  // namespace lensplane
