// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_drawing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lensplane {
namespace {

/// Standard deviations on both sides of a dot's middle that its window holds; 6e-7 of its light lies beyond.
constexpr double kWindow = 5;

/// Rows that one thread draws.
constexpr int kBand = 32;

/// Shares of a dot's light in the columns, or rows, from `first` on.
struct Shares {
  int first = 0;
  std::vector<double> of;
};

Shares shares_along(double middle, double sigma) {
  Shares shares{static_cast<int>(std::floor(middle - kWindow * sigma)), {}};
  const int last = static_cast<int>(std::floor(middle + kWindow * sigma));
  const auto below = [&](int edge) { return std::erf((edge - middle) / (sigma * std::numbers::sqrt2)); };
  const double start = below(shares.first), all = below(last + 1) - start;
  double before = start;
  for (int edge = shares.first + 1; edge <= last + 1; ++edge) {
    const double here = below(edge);
    shares.of.push_back((here - before) / all);
    before = here;
  }
  return shares;
}

/// Adds a dot to the rows from `top` to before `bottom`.
void draw(const StarImage& image, double sigma, int top, int bottom, Picture& picture) {
  const Shares across = shares_along(image.film.x - picture.x, sigma);
  const Shares down = shares_along(image.film.y - picture.y, sigma);
  const int wide = static_cast<int>(across.of.size()), high = static_cast<int>(down.of.size());
  for (int row = std::max(top, down.first); row < std::min(bottom, down.first + high); ++row) {
    const double in_row = down.of[static_cast<std::size_t>(row - down.first)];
    const int end = std::min(picture.width, across.first + wide);
    for (int column = std::max(0, across.first); column < end; ++column) {
      const double share = in_row * across.of[static_cast<std::size_t>(column - across.first)];
      Rgba& pixel = picture.at(column, row);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] += static_cast<float>(share * image.light[c]);
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
