// SPDX-License-Identifier: Apache-2.0
//
// Newton's method for images: the film position in a cell through which a given direction is seen.
//
// Many searches go side by side, so that their rays fill batches.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "src/sky_rays.h"

namespace lensplane {

/// One search: where in a cell is `direction` seen?
struct ImageSearchStart {
  std::size_t point;    // whose image it is
  Vec3 direction;       // unit vector in the world
  FilmPosition film;    // where the search starts
  FilmPosition centre;  // of the cell
  double size;          // of the cell, pixels
  bool regular;         // a single image, well within reach
  double last_step;     // the search ends with a step of so few pixels: the next one would be smaller by far
};

/// An image of a point at infinity.
struct PointImage {
  std::size_t point = 0;
  FilmPosition film{0, 0};
  double magnification = 0;  // signed
};

/// Images are taken for one where they are of one point and parity and nearer than this, in pixels; those so
/// near outside a cell are found, too. What rounding, or steps of curved rays, cannot make two of one.
inline constexpr double kSameImage = 0.01;

/// Error of an image's position in pixels, where rounding of directions (about 1e-15 rad) allows it.
inline constexpr double kImageError = 1e-6;

/// Relative error of an image's magnification, but near a critical curve.
inline constexpr double kMagnificationError = 1e-4;

/// The images that searches end at, in the order of the searches. Searches that leave their cell end at none.
std::vector<PointImage> find_by_newton(const SkyRays& rays, std::span<const ImageSearchStart> starts);

}  // namespace lensplane
