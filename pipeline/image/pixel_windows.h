// SPDX-License-Identifier: Apache-2.0
//
// Where an image's pixels lie.

#pragma once

#include <cstddef>

namespace lensplane {

/// The pixels are those of a data window, whose upper left corner lies at (x, y) of a display window of
/// `display_width` x `display_height`; the two are the same unless there is overscan or a crop.
struct PixelWindows {
  int width = 0;
  int height = 0;
  int x = 0;
  int y = 0;
  int display_width = 0;
  int display_height = 0;

  /// Of a pixel of the data window, counted from its upper left corner, row by row.
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }

  /// Whether the data window has the pixel that is counted from the display window's upper left corner.
  bool stores(int column, int row) const {
    return column >= x && column - x < width && row >= y && row - y < height;
  }
};

}  // namespace lensplane
