// SPDX-License-Identifier: Apache-2.0

#include "src/film_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace lensplane {
namespace {

/// So many steps fit into a side; at least one pixel is taken.
int count_along(int side, int step) {
  return std::max(1, side / step);
}

}  // namespace

FilmPosition FilmGrid::at(int index) const {
  const int first = step / 2;  // in the middle of its square
  return {index % columns * step + first + 0.5, index / columns * step + first + 0.5};
}

FilmGrid grid_of(const Camera& camera, int most) {
  FilmGrid grid;
  const auto fits = [&](int step) {
    grid = {step, count_along(camera.width, step), count_along(camera.height, step)};
    return static_cast<std::int64_t>(grid.columns) * grid.rows <= std::max(most, 1);
  };
  // No step is longer than the shorter side, or the frame's last pixels would be passed over.
  int step = 1;
  while (!fits(step) && step < std::min(camera.width, camera.height)) ++step;
  return grid;
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
