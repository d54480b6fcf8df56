// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/planned_frame.h"

#include <limits>

namespace lensplane {

std::vector<LensPlan> lenses_of(const PlannedFrame& planned) {
  if (planned.plan.method == Method::Planes) return planned.plan.lenses;
  std::vector<LensPlan> lenses;
  for (std::size_t i = 0; i < planned.scene.lenses.size(); ++i) {
    LensPlan lens;
    lens.lens = i;
    lens.moves_px = std::numeric_limits<double>::infinity();
    lens.reason = "the method leaves no lens out";
    lenses.push_back(lens);
  }
  return lenses;
}

double distance_of(const PlannedFrame& planned, const LensPlan& lens) {
  return (planned.scene.lenses[lens.lens].position - planned.scene.camera.position).length();
}

}  // namespace lensplane
