// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_drawing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace lensplane {
namespace {

/// Standard deviations on both sides of a dot's middle that its window holds; 1e-4 of its light lies beyond.
constexpr double kWindow = 4;

/// Rows that one thread draws.
constexpr int kBand = 32;

/// Pixels of a dot along one axis at most.
constexpr int kMostPixels = 64;

/// Phi, the integral of the normal distribution, from a table: right to 1e-6.
class CumulativeNormal {
 public:
  CumulativeNormal() {
    for (int i = 0; i <= kSteps + 1; ++i) {
      values_[static_cast<std::size_t>(i)] = 0.5 * std::erfc((kEnd - i / kPerUnit) / std::numbers::sqrt2);
    }
  }
  double operator()(double z) const {
    const double place = (std::clamp(z, -kEnd, kEnd) + kEnd) * kPerUnit;
    const auto i = static_cast<std::size_t>(place);
    return values_[i] + (values_[i + 1] - values_[i]) * (place - static_cast<double>(i));
  }

 private:
  static constexpr double kEnd = 6;
  static constexpr double kPerUnit = 256;
  static constexpr int kSteps = static_cast<int>(2 * kEnd * kPerUnit);
  std::array<double, kSteps + 2> values_;
};

/// Shares of a dot's light in the columns, or rows, from `first` to before `end`.
struct Shares {
  int first = 0, end = 0;
  std::array<float, kMostPixels> of;
};

Shares shares_along(double middle, double sigma) {
  static const CumulativeNormal below;
  const double reach = std::min(kWindow * sigma, 0.5 * (kMostPixels - 2));
  Shares shares;
  shares.first = static_cast<int>(std::floor(middle - reach));
  shares.end = static_cast<int>(std::floor(middle + reach)) + 1;
  const double start = below((shares.first - middle) / sigma);
  const double all = below((shares.end - middle) / sigma) - start;
  double before = start;
  for (int pixel = shares.first; pixel < shares.end; ++pixel) {
    const double here = below((pixel + 1 - middle) / sigma);
    shares.of[static_cast<std::size_t>(pixel - shares.first)] = static_cast<float>((here - before) / all);
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
  const int left = std::max(0, across.first), right = std::min(picture.width, across.end);
  for (int row = std::max(top, down.first); row < std::min(bottom, down.end); ++row) {
    const float in_row = down.of[static_cast<std::size_t>(row - down.first)];
    for (int column = left; column < right; ++column) {
      const float share = in_row * across.of[static_cast<std::size_t>(column - across.first)];
      Rgba& pixel = picture.at(column, row);
      for (std::size_t c = 0; c < 4; ++c) pixel[c] += share * colour[c];
    }
  }
}

/// For every band the numbers of the images that reach into it, in their order.
std::vector<std::vector<std::size_t>> images_by_band(std::span<const StarImage> images, double reach,
                                                     const Picture& picture) {
  std::vector<std::vector<std::size_t>> bands(static_cast<std::size_t>((picture.height + kBand - 1) / kBand));
  for (std::size_t n = 0; n < images.size(); ++n) {
    const double x = images[n].film.x - picture.x, y = images[n].film.y - picture.y;
    const bool near = x > -reach && x < picture.width + reach && y > -reach && y < picture.height + reach;
    if (!near) continue;
    const auto first = static_cast<std::size_t>(std::max(0.0, (y - reach) / kBand));
    for (std::size_t band = first; band < bands.size() && static_cast<double>(band) * kBand < y + reach;
         ++band) {
      bands[band].push_back(n);
    }
  }
  return bands;
}

}  // namespace

void draw_stars(std::span<const StarImage> images, const PointSpread& spread, Picture& picture) {
  const auto bands = images_by_band(images, spread.reach_px(), picture);
  tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t band) {
    const int top = static_cast<int>(band) * kBand, bottom = std::min(top + kBand, picture.height);
    for (const std::size_t n : bands[band]) draw(images[n], spread.sigma_px, top, bottom, picture);
  });
}

}  // namespace lensplane
