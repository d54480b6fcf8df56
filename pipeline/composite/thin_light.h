// SPDX-License-Identifier: Apache-2.0
//
// What thin bodies add to the pixels of a tile, and how much of each is left for all else.

#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/composite/thin_bodies.h"

namespace lensplane {

/// What is seen: light, and what of it ends in masses and is covered by nothing.
struct SeenLight {
  Rgba colour{0, 0, 0, 0};
  float shadow = 0;
};

/// The light of rays over thin images, in the pixels of a rectangle of the film.
class ThinLight {
 public:
  ThinLight() = default;

  /// The pixel (0, 0) has its upper left corner at (left, top) on the film.
  ThinLight(double left, double top, int width, int height);

  /// Is there any?
  bool empty() const { return pixels_.empty(); }

  /// Adds a ray and what it sees; calls `count(column, row, weight)` for each pixel that it adds to, whose
  /// share it is.
  template <class Count>
  void add(const ThinRay& ray, const SeenLight& seen, Count count);

  /// How much of a pixel thin bodies leave to all else.
  double rest(int column, int row) const;

  /// What the pixel sees, where all else has the mean `background`.
  SeenLight over(int column, int row, const SeenLight& background) const;

 private:
  struct Pixel {
    SeenLight seen;
    double weight = 0;
  };
  const Pixel& at(int column, int row) const {
    return pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(column)];
  }

  double left_ = 0, top_ = 0;
  int width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
};

template <class Count>
void ThinLight::add(const ThinRay& ray, const SeenLight& seen, Count count) {
  const double x = ray.film.x - left_ - 0.5, y = ray.film.y - top_ - 0.5;  // from the first pixel's centre
  const int first_column = static_cast<int>(std::floor(x)) - kThinReach + 1,
            first_row = static_cast<int>(std::floor(y)) - kThinReach + 1;
  for (int row = std::max(0, first_row); row < std::min(height_, first_row + 2 * kThinReach); ++row) {
    const double of_row = ray.area * pixel_weight(y - row);
    for (int column = std::max(0, first_column); column < std::min(width_, first_column + 2 * kThinReach);
         ++column) {
      const double weight = of_row * pixel_weight(x - column);
      Pixel& pixel = pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                             static_cast<std::size_t>(column)];
      const auto share = static_cast<float>(weight);
      for (std::size_t c = 0; c < 4; ++c) pixel.seen.colour[c] += share * seen.colour[c];
      pixel.seen.shadow += share * seen.shadow;
      pixel.weight += weight;
      count(column, row, weight);
    }
  }
}

}  // namespace lensplane
