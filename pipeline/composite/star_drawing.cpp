// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_drawing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lensplane {
namespace {

/// Standard deviations on both sides of a dot's middle that its window holds; 1e-4 of its light lies beyond.
constexpr double kWindow = 4;

/// Rows that one thread draws.
constexpr int kBand = 32;

/// Shares of a dot's light in the columns, or rows, from `first` on.
struct Shares {
  int first = 0;
  std::vector<float> of;
};

Shares shares_along(double middle, double sigma) {
  Shares shares{static_cast<int>(std::floor(middle - kWindow * sigma)), {}};
  const int last = static_cast<int>(std::floor(middle + kWindow * sigma));
  const auto below = [&](int edge) { return std::erf((edge - middle) / (sigma * std::numbers::sqrt2)); };
  const double start = below(shares.first), all = below(last + 1) - start;
  shares.of.reserve(static_cast<std::size_t>(last - shares.first + 1));
  double before = start;
  for (int edge = shares.first + 1; edge <= last + 1; ++edge) {
    const double here = below(edge);
    shares.of.push_back(static_cast<float>((here - before) / all));
    before = here;
  }
  return shares;
}

/// Adds a dot to the rows from `top` to before `bottom`.
void draw(const StarImage& image, double sigma, int top, int bottom, Picture& picture) {
  const Shares across = shares_along(image.film.x - picture.x, sigma);
  const Shares down = shares_along(image.film.y - picture.y, sigma);
  const auto light = [&](std::size_t c) { return static_cast<float>(image.light[c]); };
  const Rgba colour{light(0), light(1), light(2), 0.0F};
  const int left = std::max(0, across.first), upper = std::max(top, down.first);
  const int right = std::min(picture.width, across.first + static_cast<int>(across.of.size()));
  const int lower = std::min(bottom, down.first + static_cast<int>(down.of.size()));
  for (int row = upper; row < lower; ++row) {
    const float in_row = down.of[static_cast<std::size_t>(row - down.first)];
    for (int column = left; column < right; ++column) {
      const float share = in_row * across.of[static_cast<std::size_t>(column - across.first)];
      Rgba& pixel = picture.at(column, row);
      for (std::size_t c = 0; c < 4; ++c) pixel[c] += share * colour[c];
    }
  }
}

}  // namespace

void draw_stars(std::span<const StarImage> images, const PointSpread& spread, Picture& picture) {
  const double reach = spread.reach_px();
  tbb::parallel_for(0, (picture.height + kBand - 1) / kBand, [&](int band) {
    const int top = band * kBand, bottom = std::min(top + kBand, picture.height);
    for (const StarImage& image : images) {
      const double x = image.film.x - picture.x, y = image.film.y - picture.y;
      const bool near = x > -reach && x < picture.width + reach && y > top - reach && y < bottom + reach;
      if (near) draw(image, spread.sigma_px, top, bottom, picture);
    }
  });
}

}  // namespace lensplane
