// SPDX-License-Identifier: Apache-2.0
//
// Drawing stars: each image a dot of constant width, at its place between the pixels.
//
// A dot is a Gaussian whose integral over each pixel is taken, within a window of pixels, and scaled so that
// it adds up to the image's light exactly: a star that drifts over the film does not flicker.

#pragma once

#include <span>

#include "pipeline/composite/star_images.h"
#include "pipeline/image/picture.h"

namespace lensplane {

/// How a point is seen.
struct PointSpread {
  double sigma_px = 0.6;  // standard deviation in pixels, > 0 and up to 7

  /// Pixels from its middle beyond which a dot has no light: ImageSearch::margin_px should be as large.
  double reach_px() const { return 4.0 * sigma_px + 1.0; }
};

/// Adds the images' light to the picture; alpha stays as it is. Pixels of the picture are pixels of the film,
/// its display window the frame without overscan. Runs in parallel; the number of threads changes nothing.
void draw_stars(std::span<const StarImage> images, const PointSpread& spread, Picture& picture);

}  // namespace lensplane
