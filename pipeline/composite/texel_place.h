// SPDX-License-Identifier: Apache-2.0
//
// Which stored texel stands at a position, inside of a picture and beyond its edges.
//
// Positions count texels of the display window, from its upper left corner. What is stored may be more than
// that (overscan) or less (a crop). Every level of a pyramid has such windows, and the same rules.

#pragma once

#include "pipeline/image/pixel_windows.h"

namespace lensplane {

// Black     transparent black
// Clamp     the nearest pixel
// Mirror    the picture mirrored at its edges
// Repeat    the picture again
// Globe     longitude repeats; beyond a pole lies the other side of the globe
enum class Wrap { Black, Clamp, Mirror, Repeat, Globe };

/// A position, and how many texels on the right of it are stored side by side, itself included; 0 where
/// nothing is stored: transparent black.
struct TexelPlace {
  int column = 0;
  int row = 0;
  int count = 0;
};

/// Where the texel at any position is stored.
TexelPlace place_of(const PixelWindows& window, Wrap wrap, int column, int row);

}  // namespace lensplane
