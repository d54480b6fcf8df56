// SPDX-License-Identifier: Apache-2.0
//
// What filters read: the texels of a pyramid's levels, wherever they are kept.
//
// A reader lives for one lookup, in one thread. Texels come in runs, as many as lie side by side in memory,
// so that filters walk rows without asking for every texel.

#pragma once

#include <vector>

#include "pipeline/composite/texel_window.h"
#include "pipeline/image/picture.h"

namespace lensplane {

/// One level of a pyramid. Its texels have been filtered; that filter's variance is known, so that a lookup
/// filters the less.
struct TexelLevel {
  TexelWindow window;
  double variance_x = 0;  // in texels of this level, squared
  double variance_y = 0;
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

  /// The texel at any position of a level, and what follows it on its right. Valid until the next call.
  TexelRun run(int level, int column, int row) {
    static constexpr Rgba kClear{0, 0, 0, 0};
    const TexelWindow& window = levels_[static_cast<std::size_t>(level)].window;
    if (window.stores(column, row)) return stored(level, {column, row, window.x + window.width - column});
    const TexelPlace place = place_of(window, wrap_, column, row);
    return place.count > 0 ? stored(level, place) : TexelRun{&kClear, 1};
  }

 private:
  /// At most `place.count` texels, at least one.
  virtual TexelRun stored(int level, const TexelPlace& place) = 0;

  const std::vector<TexelLevel>& levels_;
  Wrap wrap_;
};

}  // namespace lensplane
