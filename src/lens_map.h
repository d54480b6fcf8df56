// SPDX-License-Identifier: Apache-2.0
//
// The deflection map of a frame: for every pixel centre, which point of a surface is seen there.

#pragma once

#include <vector>

#include "src/tracer.h"

namespace lensplane {

/// The map of one surface: row by row from the top, the overscan included. Where `valid` is 0, s = t = 0.
struct LensMap {
  int width = 0;
  int height = 0;
  std::vector<float> s, t, valid;
};

/// Traces all pixel centres of the tracer's camera, one map per surface. Runs in parallel; the maps do not
/// depend on the number of threads.
std::vector<LensMap> trace_maps(const Tracer& tracer);

}  // namespace lensplane
