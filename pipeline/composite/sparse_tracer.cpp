// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/sparse_tracer.h"

#include <algorithm>

#include "src/bodies.h"

namespace lensplane {
namespace {

bool meets_nothing(const TraceBatch& batch) {
  const bool any_captured =
      std::any_of(batch.captured, batch.captured + kBatchSize, [](double c) { return c != 0; });
  return !any_captured &&
         std::none_of(batch.surfaces.begin(), batch.surfaces.end(), [](const SurfaceBatch& surface) {
           return std::find(surface.outcome.begin(), surface.outcome.end(), Outcome::Hit) !=
                  surface.outcome.end();
         });
}

}  // namespace

SparseTracer::SparseTracer(const Tracer& tracer, const EmptySpace& empty)
    : tracer_(tracer), empty_(empty), plain_(tracer.without_passes()), plain_batch_(plain_.make_batch()) {
  all_bodies_ = std::all_of(tracer.surfaces().begin(), tracer.surfaces().end(), is_body);
}

Found SparseTracer::trace(TraceBatch& batch) {
  const EmptySpace::Known known = empty_.known_of(batch);
  if (known == EmptySpace::Known::MeetsNothing) return Found::NothingNew;
  if (known == EmptySpace::Known::Nothing && all_bodies_ && last_met_nothing_ &&
      plain_rays_meet_nothing(batch)) {
    for (SurfaceBatch& surface : batch.surfaces) surface.outcome.fill(Outcome::Missed);
    return Found::Nothing;
  }
  tracer_.trace(batch);
  last_met_nothing_ = meets_nothing(batch);
  return last_met_nothing_ ? Found::Nothing : Found::Something;
}

bool SparseTracer::plain_rays_meet_nothing(const TraceBatch& batch) {
  std::copy_n(batch.x, kBatchSize, plain_batch_.x);
  std::copy_n(batch.y, kBatchSize, plain_batch_.y);
  plain_.trace(plain_batch_);
  return meets_nothing(plain_batch_) && unresolved_rays(plain_batch_, kBatchSize) == 0;
}

}  // namespace lensplane
