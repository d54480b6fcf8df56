// SPDX-License-Identifier: Apache-2.0
//
// Which stored texel stands at a position, inside of a picture and beyond its edges.
//
// Positions count texels of the display window, from its upper left corner. What is stored may be more than
// that (overscan) or less (a crop). Every level of a pyramid has such a window, and the same rules.

#pragma once

namespace lensplane {

// Black     transparent black
// Clamp     the nearest pixel
// Mirror    the picture mirrored at its edges
// Repeat    the picture again
// Globe     longitude repeats; beyond a pole lies the other side of the globe
enum class Wrap { Black, Clamp, Mirror, Repeat, Globe };

struct TexelWindow {
  int x = 0;  // the stored window's upper left corner
  int y = 0;
  int width = 0;  // the stored window's size
  int height = 0;
  int display_width = 0;
  int display_height = 0;

  bool stores(int column, int row) const {
    return column >= x && column - x < width && row >= y && row - y < height;
  }
};

/// A position, and how many texels on the right of it are stored side by side, itself included; 0 where
/// nothing is stored: transparent black.
struct TexelPlace {
  int column = 0;
  int row = 0;
  int count = 0;
};

/// Where the texel at any position is stored.
TexelPlace place_of(const TexelWindow& window, Wrap wrap, int column, int row);

}  // namespace lensplane
