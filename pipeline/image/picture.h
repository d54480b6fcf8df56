// SPDX-License-Identifier: Apache-2.0
//
// Pixels in memory, ready to be worked with.

#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "pipeline/image/pixel_windows.h"
#include "src/unset_allocator.h"

namespace lensplane {

using Rgba = std::array<float, 4>;

/// Pixels row by row from the top. Linear light in the shot's working space, premultiplied by alpha.
struct Picture : PixelWindows {
  UnsetVector<Rgba> pixels;      // resize() leaves them as memory is
  std::int64_t not_numbers = 0;  // pixels of the file that were NaN or infinite, and were replaced by black

  const Rgba& at(int column, int row) const { return pixels[index(column, row)]; }
  Rgba& at(int column, int row) { return const_cast<Rgba&>(std::as_const(*this).at(column, row)); }
};

}  // namespace lensplane
