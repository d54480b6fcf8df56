// SPDX-License-Identifier: Apache-2.0
//
// Drawing stars: each image a dot (star_dot.h), at its place between the pixels.
//
// A dot's integral over each pixel is taken, within a window of pixels, and scaled so that it adds up to its
// light exactly: a star that drifts over the film does not flicker.

#pragma once

#include <span>

#include "pipeline/composite/star_dot.h"
#include "pipeline/image/picture.h"

namespace lensplane {

/// Adds the images' light, as `camera` sees it, to the picture; alpha stays as it is. Pixels of the picture
/// are pixels of the film, its display window the frame without overscan. Runs in parallel; the number of
/// threads changes nothing.
void draw_stars(std::span<const StarImage> images, const PointSpread& spread, const Camera& camera,
                Picture& picture);

}  // namespace lensplane
