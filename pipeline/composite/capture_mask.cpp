// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/capture_mask.h"

#include <cmath>

namespace lensplane {

CaptureMask::CaptureMask(int width, int height)
    : width_(width),
      height_(height),
      captured_(static_cast<std::size_t>(width + 4) * static_cast<std::size_t>(height + 4), 0) {}

std::vector<CaptureMask::RimPixel> CaptureMask::rim_pixels() const {
  std::vector<RimPixel> pixels;
  for (int row = 0; row < height_; ++row) {
    for (int column = 0; column < width_; ++column) {
      int captured = 0, x = 0, y = 0;  // how many, and the sum of the steps to them
      for (int down = -2; down <= 2; ++down) {
        for (int right = -2; right <= 2; ++right) {
          if (captured_[place(column + right, row + down)] == 0) continue;
          ++captured, x += right, y += down;
        }
      }
      if (captured == 0 || captured == 25) continue;
      const double length = std::hypot(x, y);
      pixels.push_back({column, row, length > 0 ? -x / length : 1, length > 0 ? -y / length : 0});
    }
  }
  return pixels;
}

}  // namespace lensplane
