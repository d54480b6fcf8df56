// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/texture.h"

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

/// Far outside of any picture lookups need no more precision than pixel numbers have.
int clamped_floor(double x) {
  constexpr double kFar = 1e9;
  return static_cast<int>(std::floor(std::clamp(x, -kFar, kFar)));
}

/// Calls `use` with a reader of the texels.
auto with_reader(const std::variant<Pyramid, TiledTexture>& source, Wrap wrap, auto use) {
  if (const auto* pyramid = std::get_if<Pyramid>(&source)) {
    PyramidTexels texels(*pyramid, wrap);
    return use(texels);
  }
  TiledTexels texels(std::get<TiledTexture>(source), wrap);
  return use(texels);
}

Rgba bilinear(Texels& texels, TextureCoordinates st) {
  const PixelWindows& window = texels.levels().front().window;
  const double x = st.s * window.display_width - 0.5;
  const double y = (1.0 - st.t) * window.display_height - 0.5;
  const int column = clamped_floor(x);
  const int row = clamped_floor(y);
  const auto right = static_cast<float>(std::clamp(x - column, 0.0, 1.0));
  const auto down = static_cast<float>(std::clamp(y - row, 0.0, 1.0));
  const auto texel = [&](int i, int j) { return *texels.row(0, i, j, 1); };
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

}  // namespace

Rgba Texture::lookup(TextureCoordinates st) const {
  return with_reader(source_, wrap_, [&](auto& texels) { return bilinear(texels, st); });
}

Rgba Texture::filtered(TextureCoordinates st, const Footprint& footprint) const {
  if (footprint.scale == 0 && std::isfinite(st.s) && std::isfinite(st.t)) return lookup(st);
  return with_reader(source_, wrap_, [&](auto& texels) { return filtered_texels(texels, st, footprint); });
}

const PixelWindows& Texture::windows() const {
  if (const auto* pyramid = std::get_if<Pyramid>(&source_)) return pyramid->pictures.front();
  return std::get<TiledTexture>(source_).windows();
}

std::size_t Texture::bytes() const {
  const auto* pyramid = std::get_if<Pyramid>(&source_);
  return pyramid ? pyramid->pictures.front().pixels.size() * sizeof(Rgba) : 0;
}

std::int64_t Texture::not_numbers() const {
  if (const auto* pyramid = std::get_if<Pyramid>(&source_)) return pyramid->pictures.front().not_numbers;
  return std::get<TiledTexture>(source_).not_numbers();
}

}  // namespace lensplane
