// SPDX-License-Identifier: Apache-2.0
//
// A frame and its plan, for those who print it.

#pragma once

#include <vector>

#include "pipeline/sequence/plate_margins.h"
#include "pipeline/sequence/shutter.h"
#include "src/plan.h"

namespace lensplane {

struct PlannedFrame {
  int frame;
  Scene scene;
  TraceSettings settings;
  Plan plan;
  std::vector<PlateMargin> margins = {};  // of all plates, by all pixels
  ShutterSampling shutter = {};
};

/// What becomes of every lens, by any method. The paper's methods bend by all lenses, with the weak law, and
/// the geodesic method curves light round all of them: neither bounds how far each moves what is seen.
std::vector<LensPlan> lenses_of(const PlannedFrame& planned);

/// Metres from the camera to a lens.
double distance_of(const PlannedFrame& planned, const LensPlan& lens);

}  // namespace lensplane
