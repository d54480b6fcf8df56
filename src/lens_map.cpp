// SPDX-License-Identifier: Apache-2.0

#include "src/lens_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace lensplane {
namespace {

void store(const SurfaceBatch& surface, std::size_t first, int count, LensMap& map) {
  for (int i = 0; i < count; ++i) {
    const std::size_t at = first + static_cast<std::size_t>(i);
    map.s[at] = static_cast<float>(surface.s[i]);
    map.t[at] = static_cast<float>(surface.t[i]);
    map.valid[at] = surface.outcome[static_cast<std::size_t>(i)] == Outcome::Hit ? 1.0F : 0.0F;
  }
}

/// Fills row `row` of every map.
void trace_row(const Tracer& tracer, int row, TraceBatch& batch, std::vector<LensMap>& maps) {
  const int overscan = tracer.camera().overscan;
  const int width = tracer.camera().full_width();
  for (int column = 0; column < width; column += kBatchSize) {
    const int count = std::min(kBatchSize, width - column);
    for (int i = 0; i < kBatchSize;
         ++i) {  // the last batch of a row reaches beyond it; those rays are not used
      batch.x[i] = column + i - overscan + 0.5;
      batch.y[i] = row - overscan + 0.5;
    }
    tracer.trace(batch);
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
    for (std::size_t k = 0; k < maps.size(); ++k) store(batch.surfaces[k], first, count, maps[k]);
  }
}

}  // namespace

std::vector<LensMap> trace_maps(const Tracer& tracer) {
  const int width = tracer.camera().full_width();
  const int height = tracer.camera().full_height();
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::vector<float> blank(pixels, 0.0F);
  std::vector<LensMap> maps(tracer.surfaces().size(), LensMap{width, height, blank, blank, blank});
  tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const tbb::blocked_range<int>& rows) {
    TraceBatch batch = tracer.make_batch();
    for (int row = rows.begin(); row != rows.end(); ++row) trace_row(tracer, row, batch, maps);
  });
  return maps;
}

}  // namespace lensplane
