// SPDX-License-Identifier: Apache-2.0
//
// What filters read: the texels of a pyramid's levels, wherever they are kept.
//
// A reader lives for one lookup, in one thread. Texels come by rows, so that filters do not ask for every
// texel.

#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/composite/texel_place.h"
#include "pipeline/image/picture.h"
#include "src/inlining.h"

namespace lensplane {

/// One level of a pyramid. Its texels have been filtered; that filter's variance is known, so that a lookup
/// filters the less.
struct TexelLevel {
  PixelWindows window;
  double variance_x = 0;  // in texels of this level, squared
  double variance_y = 0;
  const Rgba* texels = nullptr;  // row by row, when all that the window stores is in memory
};

/// Texels side by side, `count` > 0 of them.
struct TexelRun {
  const Rgba* texels = nullptr;
  int count = 0;
};

class Texels {
 public:
  Texels(const std::vector<TexelLevel>& levels, Wrap wrap) : levels_(levels), wrap_(wrap) {}
  virtual ~Texels() = default;
  Texels(const Texels&) = delete;
  Texels& operator=(const Texels&) = delete;

  /// The finest level first; the last has one texel, or is the coarsest that a file has.
  const std::vector<TexelLevel>& levels() const { return levels_; }
  Wrap wrap() const { return wrap_; }

  /// `count` > 0 texels side by side, the first at any position of a level. Valid until the next call.
  LENSPLANE_ALWAYS_INLINE const Rgba* row(int level, int column, int row, int count) {
    const TexelLevel& from = levels_[static_cast<std::size_t>(level)];
    const PixelWindows& window = from.window;
    if (from.texels && window.stores(column, row) && window.stores(column + count - 1, row)) {
      return from.texels + std::ptrdiff_t{row - window.y} * window.width + (column - window.x);
    }
    return found(level, column, row, count);
  }

  /// The texel whose centre is nearest to (x, y), counted in texels from the centre of the first.
  Rgba nearest(int level, double x, double y) {
    return *row(level, static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)), 1);
  }

 private:
  [[gnu::noinline]] const Rgba* found(int level, int column, int row, int count) {
    const PixelWindows& window = levels_[static_cast<std::size_t>(level)].window;
    if (window.stores(column, row) && window.stores(column + count - 1, row)) {
      const TexelRun run = stored(level, {column, row, count});
      if (run.count >= count) return run.texels;
    }
    return gathered(level, column, row, count);
  }

  /// The texel at any position of a level, and what follows it on its right.
  TexelRun run(int level, int column, int row) {
    static constexpr Rgba kClear{0, 0, 0, 0};
    const PixelWindows& window = levels_[static_cast<std::size_t>(level)].window;
    if (window.stores(column, row)) return stored(level, {column, row, window.x + window.width - column});
    const TexelPlace place = place_of(window, wrap_, column, row);
    return place.count > 0 ? stored(level, place) : TexelRun{&kClear, 1};
  }

  const Rgba* gathered(int level, int column, int row, int count) {
    gathered_.assign(static_cast<std::size_t>(count), Rgba{0, 0, 0, 0});
    int from = 0, until = count;
    if (wrap_ == Wrap::Black) {  // there is nothing but what is stored
      const PixelWindows& window = levels_[static_cast<std::size_t>(level)].window;
      from = std::max(0, window.x - column);
      until = window.stores(window.x, row) ? std::min(count, window.x + window.width - column) : 0;
    }
    for (int i = from; i < until;) {
      const TexelRun next = run(level, column + i, row);
      const int taken = std::min(next.count, until - i);
      std::copy_n(next.texels, taken, gathered_.begin() + i);
      i += taken;
    }
    return gathered_.data();
  }

  /// At most `place.count` texels, at least one.
  virtual TexelRun stored(int level, const TexelPlace& place) = 0;

  const std::vector<TexelLevel>& levels_;
  Wrap wrap_;
  std::vector<Rgba> gathered_;
};

}  // namespace lensplane
