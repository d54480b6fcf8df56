// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/shot_glow.h"

namespace lensplane {

std::optional<Glow> glow_at(const Shot& shot, double frame) {
  if (!shot.camera.glow) return std::nullopt;
  const double strength = value_at(shot.camera.glow->strength, frame);
  if (strength == 0) return std::nullopt;
  return Glow{strength, value_at(shot.camera.glow->radius, frame) * shot.camera.width,
              shot.camera.projection};
}

}  // namespace lensplane
