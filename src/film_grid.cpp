// SPDX-License-Identifier: Apache-2.0

#include "src/film_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace lensplane {
namespace {

/// Pixels along a side, one at least, and how many lie before the first.
struct Along {
  int count, first;
};
Along along(int side, int step) {
  const int count = std::max(1, side / step);
  return {count, (side - 1 - (count - 1) * step) / 2};
}

}  // namespace

FilmPosition FilmGrid::at(int index) const {
  return {index % columns * step + left + 0.5, index / columns * step + top + 0.5};
}

FilmGrid grid_of(const Camera& camera, int most) {
  for (int step = 1;; ++step) {
    const Along x = along(camera.width, step), y = along(camera.height, step);
    const FilmGrid grid{step, x.count, y.count, x.first, y.first};
    if (static_cast<std::int64_t>(x.count) * y.count <= std::max(most, 1)) return grid;
  }
}

std::vector<TraceBatch> trace_grid(const Tracer& tracer, const FilmGrid& grid) {
  const int batches = (grid.count() + kBatchSize - 1) / kBatchSize;
  std::vector<TraceBatch> result(static_cast<std::size_t>(batches));
  tbb::parallel_for(tbb::blocked_range<int>(0, batches), [&](const tbb::blocked_range<int>& range) {
    for (int n = range.begin(); n != range.end(); ++n) {
      TraceBatch& batch = result[static_cast<std::size_t>(n)];
      batch = tracer.make_batch();
      for (int i = 0; i < kBatchSize; ++i) {
        const FilmPosition film = grid.at(std::min(n * kBatchSize + i, grid.count() - 1));
        batch.x[i] = film.x;
        batch.y[i] = film.y;
      }
      tracer.trace(batch);
    }
  });
  return result;
}

}  // namespace lensplane
