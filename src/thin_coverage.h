// SPDX-License-Identifier: Apache-2.0
//
// Coverage of what is thinner than a pixel, for maps: the pixels' own rays hit it by chance. Rays over its
// images, wherever on the film they are, each stand for a piece of them, and count for the pixels round it.

#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "src/map_edges.h"
#include "src/thin_images.h"

namespace lensplane {

/// What thin images of a surface add to a pixel.
struct ThinShare {
  MapPixel pixel{0, 0};  // by the row and column of the film, overscan included
  std::size_t surface = 0;
  double share = 0;         // of the pixel filter
  FilmPosition film{0, 0};  // a ray that sees the surface, the one that counts most
  TexturePoint<double> st{0, 0};
};

/// The thin images on a film, and what they cover.
class ThinCoverage {
 public:
  ThinCoverage() = default;  // none

  /// `sigma`: the pixel filter's standard deviation, pixels. Over all pixels the filter's weights are made to
  /// add up to 1.
  ThinCoverage(const Tracer& tracer, double sigma);

  /// By row, column and surface.
  const std::vector<ThinShare>& shares() const { return shares_; }

  /// Is the film position on a thin image of the surface? Rays that are count with it, not for themselves.
  bool holds(FilmPosition film, std::size_t surface) const;

  std::int64_t rays() const { return rays_; }  // that were traced

 private:
  std::vector<ThinImage> images_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> in_pixel_;  // numbers of images
  std::vector<ThinShare> shares_;
  std::int64_t rays_ = 0;
};

}  // namespace lensplane
