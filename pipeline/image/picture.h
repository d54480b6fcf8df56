// SPDX-License-Identifier: Apache-2.0
//
// Pixels in memory, ready to be worked with.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace lensplane {

using Rgba = std::array<float, 4>;

/// Pixels row by row from the top. Linear light in the shot's working space, premultiplied by alpha.
///
/// The pixels are those of a data window, whose upper left corner lies at (x, y) of a display window of
/// `display_width` x `display_height`; the two are the same unless there is overscan or a crop.
struct Picture {
  int width = 0;
  int height = 0;
  int x = 0;
  int y = 0;
  int display_width = 0;
  int display_height = 0;
  std::vector<Rgba> pixels;
  std::int64_t not_numbers = 0;  // pixels of the file that were NaN or infinite, and were replaced by black

  const Rgba& at(int column, int row) const {
    return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
  Rgba& at(int column, int row) { return const_cast<Rgba&>(std::as_const(*this).at(column, row)); }
};

}  // namespace lensplane
