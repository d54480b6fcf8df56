// SPDX-License-Identifier: Apache-2.0
//
// Which pixels the rim of a shadow runs through, or past so near that it counts, from where light is
// captured.

#pragma once

#include <cstdint>
#include <vector>

namespace lensplane {

/// Where the centres of a rectangle of pixels and of two more around it are captured.
class CaptureMask {
 public:
  CaptureMask(int width, int height);

  /// Of pixels from (-2, -2) on; the rectangle begins at (0, 0).
  void set_captured(int column, int row) { captured_[place(column, row)] = 1; }

  /// A pixel near which there is light that is captured and light that is not.
  struct RimPixel {
    int column, row;
    double x, y;  // unit vector across the rim, out of the shadow as far as the pixels around tell
  };
  std::vector<RimPixel> rim_pixels() const;

 private:
  std::size_t place(int column, int row) const {
    return static_cast<std::size_t>(row + 2) * static_cast<std::size_t>(width_ + 4) +
           static_cast<std::size_t>(column + 2);
  }

  int width_, height_;
  std::vector<std::uint8_t> captured_;
};

}  // namespace lensplane
