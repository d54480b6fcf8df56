// SPDX-License-Identifier: Apache-2.0
//
// Dots of stars near the poles of a lat-long film, where they bend around the pole and over it: drawn pixel
// by pixel, by the angle on the sky.

#pragma once

#include "pipeline/composite/star_dot.h"
#include "pipeline/image/picture.h"

namespace lensplane {

/// Adds the dot's light to the rows of the picture from `top` to before `bottom`, wherever they show its
/// piece of sky: on either side of the seam, beyond the pole, and again in the overscan. So of all images of
/// a star it is to be drawn for the one alone that lies in the frame.
void draw_polar_dot(const StarImage& image, const Camera& camera, const SkySpread& sky, int top, int bottom,
                    Picture& picture);

}  // namespace lensplane
