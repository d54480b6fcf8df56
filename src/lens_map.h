// SPDX-License-Identifier: Apache-2.0
//
// The deflection map of a frame: for every pixel centre, which point of a surface is seen there, and the
// passes that were called for.

#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "src/tracer.h"
#include "src/unset_allocator.h"

namespace lensplane {

/// One channel of a data file, finite everywhere: what is larger than any float (the depth of what lies at
/// infinity) is the largest float.
struct Pass {
  std::string_view channel;  // "lensing.magnification", ...
  UnsetVector<float> values;
};

/// The map of one surface: row by row from the top, the overscan included.
struct LensMap {
  int width = 0;
  int height = 0;
  UnsetVector<float> s, t;      // of the pixel's centre; 0 where it does not see the surface
  UnsetVector<float> valid;     // 1 where it does, else 0. map_coverage.h makes all three say more of edges
  std::int64_t unresolved = 0;  // pixels whose ray was given up; they see nothing
  std::vector<Pass> passes;     // what the plan's effects call for, in the order of kEffectNames
};

/// A pass by the name of its channel; null when the map has none.
const Pass* pass_of(const LensMap& map, std::string_view channel);

/// Rows of the film, counted from the top of the overscan.
struct RowRange {
  int begin = 0;
  int end = 0;
};

/// Traces all pixel centres of the tracer's camera, one map per surface. Runs in parallel; the maps do not
/// depend on the number of threads.
std::vector<LensMap> trace_maps(const Tracer& tracer);

/// The same for some rows only: maps of any size can be made in pieces. Pieces that begin at multiples of
/// TileLevels::size are traced fastest. `maps`: those of another piece that is done with, whose memory is
/// used again: threads would have to wait for one another to get fresh memory. `above`: so many rows at the
/// beginning of the maps are left for those before `rows`.
std::vector<LensMap> trace_maps(const Tracer& tracer, RowRange rows, std::vector<LensMap> maps = {},
                                int above = 0);

}  // namespace lensplane
