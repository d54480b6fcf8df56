// SPDX-License-Identifier: Apache-2.0
//
// Where one ray a pixel is not enough: silhouettes, the shadow, critical curves, seams between surfaces.
//
// The centres of a tile's pixels, and of one more around it, are traced with their Jacobians. A pixel needs
// more rays when a neighbour meets other surfaces or meets them in another order, when the picture is
// mirrored between the two, when the light of one of them ends in a mass, or when the neighbour is not where
// the Jacobians of both say. It needs more than one footprint where the Jacobian changes much from one to the
// other.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/composite/layering.h"

namespace lensplane {

/// How far a neighbour may be from where the Jacobian puts it, as a share of the way to it, before a pixel is
/// taken for curved.
inline constexpr double kMostCurved = 0.25;

/// How much the Jacobian may change from pixel to pixel, as a share of itself, before a pixel is taken for
/// bent: an edge under one footprint is off by a hundredth of its height then.
inline constexpr double kMostBent = 0.12;

/// Whether two rays meet the same surfaces in the same order.
bool meet_alike(std::span<const SeenPoint> a, std::span<const SeenPoint> b);

/// What a pixel needs.
enum class PixelKind : std::uint8_t {
  Smooth,      // one ray
  Bent,        // one ray, but several footprints: pixel_parts.h
  Curved,      // more rays: it is mirrored between neighbours, or bent more than second derivatives say
  Silhouette,  // more: a neighbour meets other surfaces, or in another order, so that an edge is near
};

/// What the centres of a rectangle of pixels see, a border of one pixel included.
class CentreGrid {
 public:
  /// `surfaces` as the tracer's.
  CentreGrid(const std::vector<Surface>& surfaces, int width, int height);

  int full_width() const { return width_ + 2; }
  int full_height() const { return height_ + 2; }
  std::size_t size() const {
    return static_cast<std::size_t>(full_width()) * static_cast<std::size_t>(full_height());
  }

  /// Counts pixels row by row from the border's upper left; the rectangle begins at (0, 0).
  std::size_t place(int column, int row) const {
    return static_cast<std::size_t>(row + 1) * static_cast<std::size_t>(full_width()) +
           static_cast<std::size_t>(column + 1);
  }

  /// What the pixel at a place meets, in the order of the surfaces.
  std::span<SeenPoint> points(std::size_t at) {
    return {points_.data() + at * surfaces_.size(), surfaces_.size()};
  }
  std::span<const SeenPoint> points(std::size_t at) const {
    return {points_.data() + at * surfaces_.size(), surfaces_.size()};
  }

  /// Whether the light of the pixel at a place ends in a mass, whatever it meets before: 0 or 1.
  std::uint8_t& captured(std::size_t at) { return captured_[at]; }
  bool captured(std::size_t at) const { return captured_[at] != 0; }

  /// The kinds of the pixels, place by place. (Of the border's own not all that need more rays are found.)
  std::vector<PixelKind> kinds() const;

 private:
  const std::vector<Surface>& surfaces_;
  int width_, height_;
  std::vector<SeenPoint> points_;
  std::vector<std::uint8_t> captured_;
};

}  // namespace lensplane
