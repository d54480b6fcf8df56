// SPDX-License-Identifier: Apache-2.0
//
// A part of a frame's pixels that stands for all of it: every n-th pixel of every n-th row.

#pragma once

#include <vector>

#include "src/tracer.h"

namespace lensplane {

struct FilmGrid {
  int step = 1;  // pixels from one to the next, both ways
  int columns = 0;
  int rows = 0;
  int left = 0, top = 0;  // pixels before the first

  int count() const { return columns * rows; }
  /// The pixel centre number `index`, row by row from the top.
  FilmPosition at(int index) const;
};

/// The finest grid of the frame, without overscan, that has at most `most` pixels, but at least one.
FilmGrid grid_of(const Camera& camera, int most);

/// Traces the grid's pixels: kBatchSize in a batch, the last of them repeated as often as is needed to fill
/// it. Runs in parallel.
std::vector<TraceBatch> trace_grid(const Tracer& tracer, const FilmGrid& grid);

}  // namespace lensplane
