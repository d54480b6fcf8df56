// SPDX-License-Identifier: Apache-2.0
//
// The ladder of a study: every way in which a frame can be traced, from the crudest to the finest.

#pragma once

#include <string>
#include <vector>

#include "src/plan.h"

namespace lensplane {

/// One way of tracing a frame.
struct Rung {
  TraceSettings settings;
  bool of_shot = false;  // the shot's own
};

/// "planes, law auto, 0.01 px, finite distance off".
std::string name_of(const TraceSettings& settings);

/// Kishi's and the paper's methods; `planes` with each law and with the law left open at tolerances from 1 to
/// 1e-6 pixels, without and with finite distance (without a flat screen only with it: there is no other way);
/// `geodesic`; and the shot's own way, where it is not among them. No effects are called for.
std::vector<Rung> ladder_of(const Camera& camera, const TraceSettings& of_shot);

}  // namespace lensplane
