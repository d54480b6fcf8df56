// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/// Variance, in texels, of filters narrower than which colours are held to the four texels around; see
/// local_range.h.
constexpr double kNarrow = 0.15;

/// What the four texels around a place weigh that lies `share` of the way from the second to the third.
std::array<float, 4> cubic_weights(float share) {
  const float t = share, u = 1 - share;
  return {-t * u * u / 2, (2 - t * t * (5 - 3 * t)) / 2, (2 - u * u * (5 - 3 * u)) / 2, -u * t * t / 2};
}

/// A colour of the surface, and the range of the four texels around it.
struct SurfaceColour {
  Rgba colour, least, most;
};

SurfaceColour on_surface(Texels& texels, TextureCoordinates st) {
  const PixelWindows& window = texels.levels().front().window;
  const double x = st.s * window.display_width - 0.5;
  const double y = (1.0 - st.t) * window.display_height - 0.5;
  const int column = clamped_floor(x);
  const int row = clamped_floor(y);
  const auto across = cubic_weights(static_cast<float>(std::clamp(x - column, 0.0, 1.0)));
  const auto down = cubic_weights(static_cast<float>(std::clamp(y - row, 0.0, 1.0)));
  constexpr float kMost = std::numeric_limits<float>::max();
  Rgba colour{0, 0, 0, 0}, least{kMost, kMost, kMost, kMost}, most{-kMost, -kMost, -kMost, -kMost};
  for (int j = 0; j < 4; ++j) {
    const Rgba* texel = texels.row(0, column - 1, row - 1 + j, 4);
    for (std::size_t k = 0; (j == 1 || j == 2) && k < 4; ++k) {
      least[k] = std::min({least[k], texel[1][k], texel[2][k]});
      most[k] = std::max({most[k], texel[1][k], texel[2][k]});
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        colour[k] += down[static_cast<std::size_t>(j)] * across[i] * texel[i][k];
      }
    }
  }
  return {colour, least, most};
}

}  // namespace

Rgba Texture::lookup(TextureCoordinates st) const {
  return with_reader(source_, wrap_, [&](auto& texels) { return on_surface(texels, st).colour; });
}

Rgba Texture::filtered(TextureCoordinates st, const Footprint& footprint) const {
  if (footprint.scale == 0 && std::isfinite(st.s) && std::isfinite(st.t) && is_finite(footprint)) {
    const int width = windows().display_width, height = windows().display_height;
    Footprint whole = footprint;
    whole.scale = 1;
    const TexelFilter filter = texel_filter(whole, width, height);  // of the pixel that the ray is a part of
    st = {st.s + filter.dx / width, st.t - filter.dy / height};
    auto [colour, least, most] =
        with_reader(source_, wrap_, [&](auto& texels) { return on_surface(texels, st); });
    const bool narrow = filter.axes.minor < kNarrow;
    for (std::size_t k = 0; narrow && k < 4; ++k) colour[k] = std::clamp(colour[k], least[k], most[k]);
    return colour;
  }
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
