// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/texel_place.h"

#include <algorithm>

namespace lensplane {
namespace {

/// `i` modulo `n`, in [0, n).
int modulo(int i, int n) {
  const int rest = i % n;
  return rest < 0 ? rest + n : rest;
}

int mirrored(int i, int n) {
  const int folded = modulo(i, 2 * n);
  return folded < n ? folded : 2 * n - 1 - folded;
}

/// The place at a position that is not wrapped any more; `end`: where texels on the right end to follow it.
TexelPlace stored_place(const PixelWindows& window, int column, int row, int end) {
  if (!window.stores(column, row)) return {};
  return {column, row, std::min(end, window.x + window.width) - column};
}

}  // namespace

TexelPlace place_of(const PixelWindows& window, Wrap wrap, int column, int row) {
  const int width = window.display_width;
  const int height = window.display_height;
  const int right = window.x + window.width;  // past the last column that is stored
  const int bottom = window.y + window.height;
  if (window.stores(column, row)) return {column, row, right - column};
  if (column >= 0 && column < width && row >= 0 && row < height) return {};
  switch (wrap) {
    case Wrap::Black:
      break;
    case Wrap::Clamp: {  // to the nearest pixel of either window
      const int nearest = std::clamp(column, std::min(0, window.x), std::max(width, right) - 1);
      return stored_place(window, nearest,
                          std::clamp(row, std::min(0, window.y), std::max(height, bottom) - 1), nearest + 1);
    }
    case Wrap::Mirror: {
      const int folded = mirrored(column, width);
      return stored_place(window, folded, mirrored(row, height), folded + 1);
    }
    case Wrap::Repeat:
      return stored_place(window, modulo(column, width), modulo(row, height), width);
    case Wrap::Globe: {
      const int folded = modulo(row, 2 * height);
      const bool beyond_pole = folded >= height;
      return stored_place(window, modulo(beyond_pole ? column + width / 2 : column, width),
                          beyond_pole ? 2 * height - 1 - folded : folded, width);
    }
  }
  return {};
}

}  // namespace lensplane
