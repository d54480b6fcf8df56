// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/texture.h"

#include <algorithm>
#include <cmath>

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

/// Far outside of any picture lookups need no more precision than pixel numbers have.
int clamped_floor(double x) {
  constexpr double kFar = 1e9;
  return static_cast<int>(std::floor(std::clamp(x, -kFar, kFar)));
}

}  // namespace

Rgba Texture::lookup(TextureCoordinates st) const {
  const double x = st.s * picture_.display_width - 0.5;
  const double y = (1.0 - st.t) * picture_.display_height - 0.5;
  const int column = clamped_floor(x);
  const int row = clamped_floor(y);
  const auto right = static_cast<float>(std::clamp(x - column, 0.0, 1.0));
  const auto down = static_cast<float>(std::clamp(y - row, 0.0, 1.0));
  const Rgba a = texel(column, row), b = texel(column + 1, row);
  const Rgba c = texel(column, row + 1), d = texel(column + 1, row + 1);
  Rgba colour;
  for (std::size_t k = 0; k < 4; ++k) {
    const float upper = a[k] + (b[k] - a[k]) * right;
    const float lower = c[k] + (d[k] - c[k]) * right;
    colour[k] = upper + (lower - upper) * down;
  }
  return colour;
}

/// The stored pixel at a position in the display window's coordinates; transparent black where nothing is
/// stored.
Rgba Texture::stored(int column, int row) const {
  const int x = column - picture_.x;
  const int y = row - picture_.y;
  const bool inside = x >= 0 && x < picture_.width && y >= 0 && y < picture_.height;
  return inside ? picture_.at(x, y) : Rgba{0, 0, 0, 0};
}

/// The pixel at a position in the display window's coordinates, which may lie outside of it.
Rgba Texture::texel(int column, int row) const {
  const int width = picture_.display_width;
  const int height = picture_.display_height;
  if (column >= 0 && column < width && row >= 0 && row < height) return stored(column, row);
  const int left = picture_.x, right = picture_.x + picture_.width - 1;
  const int top = picture_.y, bottom = picture_.y + picture_.height - 1;
  const bool in_overscan = column >= left && column <= right && row >= top && row <= bottom;
  if (in_overscan) return stored(column, row);
  switch (wrap_) {
    case Wrap::Black:
      break;
    case Wrap::Clamp:  // to the nearest pixel of either window
      return stored(std::clamp(column, std::min(0, left), std::max(width - 1, right)),
                    std::clamp(row, std::min(0, top), std::max(height - 1, bottom)));
    case Wrap::Mirror:
      return stored(mirrored(column, width), mirrored(row, height));
    case Wrap::Repeat:
      return stored(modulo(column, width), modulo(row, height));
    case Wrap::Globe: {
      const bool beyond_pole = row < 0 || row >= height;
      return stored(modulo(beyond_pole ? column + width / 2 : column, width), mirrored(row, height));
    }
  }
  return {0, 0, 0, 0};
}

}  // namespace lensplane
