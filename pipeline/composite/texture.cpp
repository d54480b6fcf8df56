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

/// The pixel at a position in the display window, which may lie outside of the picture.
Rgba Texture::texel(int column, int row) const {
  int x = column - picture_.x;
  int y = row - picture_.y;
  const bool inside = x >= 0 && x < picture_.width && y >= 0 && y < picture_.height;
  if (inside) return picture_.at(x, y);
  const int width = picture_.display_width;
  const int height = picture_.display_height;
  switch (wrap_) {
    case Wrap::Black:
      return {0, 0, 0, 0};
    case Wrap::Clamp:
      break;
    case Wrap::Mirror:
      x = mirrored(column, width) - picture_.x;
      y = mirrored(row, height) - picture_.y;
      break;
    case Wrap::Repeat:
      x = modulo(column, width) - picture_.x;
      y = modulo(row, height) - picture_.y;
      break;
    case Wrap::Globe:
      x = modulo(row < 0 || row >= height ? column + width / 2 : column, width) - picture_.x;
      y = mirrored(row, height) - picture_.y;
      break;
  }
  return picture_.at(std::clamp(x, 0, picture_.width - 1), std::clamp(y, 0, picture_.height - 1));
}

}  // namespace lensplane
