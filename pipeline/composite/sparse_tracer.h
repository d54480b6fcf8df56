// SPDX-License-Identifier: Apache-2.0
//
// Traces batches of pixel centres of which most may meet nothing: those that are known to are left out; where
// nothing is known, plain rays go first after a batch that met nothing, and are enough for another. Light
// that is captured has met something.

#pragma once

#include "pipeline/composite/empty_space.h"
#include "src/tracer.h"

namespace lensplane {

/// What became of a batch: its rays were traced and may meet something; they meet nothing; or that was known
/// before, and no ray was traced.
enum class Found { Something, Nothing, NothingNew };

class SparseTracer {
 public:
  SparseTracer(const Tracer& tracer, const EmptySpace& empty);

  /// To be called before the batches of another place, so that no place's depend on those of another.
  void begin() { last_met_nothing_ = false; }

  /// The batch is written when there is something in it.
  Found trace(TraceBatch& batch);

 private:
  bool plain_rays_meet_nothing(const TraceBatch& batch);

  const Tracer& tracer_;
  const EmptySpace& empty_;
  Tracer plain_;
  TraceBatch plain_batch_;
  bool all_bodies_ = false;  // nothing lies at infinity, where every ray meets it
  bool last_met_nothing_ = false;
};

}  // namespace lensplane
