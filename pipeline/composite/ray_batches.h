// SPDX-License-Identifier: Apache-2.0
//
// Any number of rays, batch by batch.

#pragma once

#include <algorithm>
#include <cstddef>

#include "src/sight.h"

namespace lensplane {

/// Calls `trace(batch, count)` for rays number 0 to `rays` at film positions `position(n)`, by batches of
/// which the first `count` count, and then `use(n, i)` for each ray n, which is number i of its batch, where
/// `trace` has returned true.
template <class Position, class Trace, class Use>
void trace_in_batches(std::size_t rays, TraceBatch& batch, Position position, Trace trace, Use use) {
  for (std::size_t first = 0; first < rays; first += kBatchSize) {
    const std::size_t count = std::min<std::size_t>(kBatchSize, rays - first);
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const FilmPosition film = position(first + std::min(i, count - 1));
      batch.x[i] = film.x;
      batch.y[i] = film.y;
    }
    if (!trace(batch, count)) continue;
    for (std::size_t i = 0; i < count; ++i) use(first + i, i);
  }
}

}  // namespace lensplane
