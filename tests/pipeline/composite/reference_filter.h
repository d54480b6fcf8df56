// SPDX-License-Identifier: Apache-2.0
//
// What filtering is measured by: the pixel filter's integral over the cubic surface, less the picture's own
// filter, by very many points.

#pragma once

#include <cmath>
#include <functional>

#include "pipeline/composite/texture.h"

namespace lensplane {

/// A colour held to the range of the 4 x 4 texels around (s, t).
inline Rgba held_to_texels(const Texture& texture, TextureCoordinates st, Rgba colour) {
  const double width = texture.windows().display_width, height = texture.windows().display_height;
  const double column = std::floor(st.s * width - 0.5), row = std::floor((1 - st.t) * height - 0.5);
  Rgba least, most;
  least.fill(1e30F);
  most.fill(-1e30F);
  for (int j = -1; j <= 2; ++j) {
    for (int i = -1; i <= 2; ++i) {
      const Rgba texel = texture.lookup({(column + i + 0.5) / width, 1 - (row + j + 0.5) / height});
      for (std::size_t k = 0; k < 4; ++k) {
        least[k] = std::min(least[k], texel[k]);
        most[k] = std::max(most[k], texel[k]);
      }
    }
  }
  for (std::size_t k = 0; k < 4; ++k) colour[k] = std::max(least[k], std::min(most[k], colour[k]));
  return colour;
}

/// The pixel filter, less a Gaussian of 0.45 texels as far as it goes along either axis, summed up over a
/// lattice of film positions that reaches 4.5 standard deviations and is finer than the texels. What is
/// narrower than the texels is held to their range.
inline Rgba reference_filtered(const Texture& texture, TextureCoordinates st, const Footprint& footprint) {
  const double width = texture.windows().display_width, height = texture.windows().display_height;
  const double xx = footprint.ds_dx * width, xy = footprint.ds_dy * width;
  const double yx = footprint.dt_dx * height, yy = footprint.dt_dy * height;
  // The lattice is turned so that one of its directions is the film's that sees the longer axis.
  const double turn = std::atan2(2 * (xx * xy + yx * yy), xx * xx + yx * yx - xy * xy - yy * yy) / 2;
  const double c = std::cos(turn), s = std::sin(turn);
  constexpr double kReach = 4.5, kTexelsApart = 0.3;
  const auto left = [&](double texels_per_pixel) {  // of the standard deviation, as a share
    const double variance = std::pow(kPixelSigma * texels_per_pixel, 2),
                 own = own_variance(variance) / variance;
    return own < 1 ? std::sqrt(1 - own) : 0.0;
  };
  const double length_along = std::hypot(xx * c + xy * s, yx * c + yy * s);
  const double length_across = std::hypot(xy * c - xx * s, yy * c - yx * s);
  const double sigma_along = kPixelSigma * footprint.scale * left(length_along);
  const double sigma_across = kPixelSigma * footprint.scale * left(length_across);
  const auto steps = [&](double sigma, double texels_per_pixel) {
    return std::max(24, static_cast<int>(kReach * sigma * texels_per_pixel / kTexelsApart));
  };
  const int along = steps(sigma_along, length_along), across = steps(sigma_across, length_across);
  std::array<double, 4> sum{};
  double weights = 0;
  for (int j = -across; j <= across; ++j) {
    for (int i = -along; i <= along; ++i) {
      const double a = kReach * i / along, b = kReach * j / across;
      const double weight = std::exp(-(a * a + b * b) / 2);
      const double x = sigma_along * a * c - sigma_across * b * s;
      const double y = sigma_along * a * s + sigma_across * b * c;
      const Rgba colour = texture.lookup({st.s + footprint.ds_dx * x + footprint.ds_dy * y,
                                          st.t + footprint.dt_dx * x + footprint.dt_dy * y});
      for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * static_cast<double>(colour[k]);
      weights += weight;
    }
  }
  Rgba mean;
  for (std::size_t k = 0; k < 4; ++k) mean[k] = static_cast<float>(sum[k] / weights);
  const double narrow = std::min(sigma_along * length_along, sigma_across * length_across);
  return narrow < 0.63 ? held_to_texels(texture, st, mean) : mean;
}

/// A footprint of `major` x `minor` texels to the pixel, the longer one turned by `angle` (radians) from the
/// right towards below, the film itself by `film_angle`.
inline Footprint footprint_of(const PixelWindows& picture, double major, double minor, double angle,
                              double film_angle = 0) {
  const double c = std::cos(angle), s = std::sin(angle), fc = std::cos(film_angle), fs = std::sin(film_angle);
  const double xx = c * major * fc + s * minor * fs, xy = c * major * fs - s * minor * fc;
  const double yx = s * major * fc - c * minor * fs, yy = s * major * fs + c * minor * fc;
  return {.ds_dx = xx / picture.display_width,
          .ds_dy = xy / picture.display_width,
          .dt_dx = -yx / picture.display_height,
          .dt_dy = -yy / picture.display_height};
}

/// A picture from a function of column and row.
inline Picture painted(int width, int height, const std::function<Rgba(int, int)>& colour) {
  Picture picture{width, height, 0, 0, width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) picture.pixels.push_back(colour(column, row));
  }
  return picture;
}

/// Circles that grow finer outwards; at a distance of half of `size` they repeat in two texels.
inline Picture zone_plate(int size) {
  return painted(size, size, [size](int column, int row) {
    const double x = column + 0.5 - size / 2.0, y = row + 0.5 - size / 2.0;
    const auto value = static_cast<float>(0.5 + 0.5 * std::cos(3.14159265358979 * (x * x + y * y) / size));
    return Rgba{value, 1 - value, 0.5F * value, 1};
  });
}

}  // namespace lensplane
