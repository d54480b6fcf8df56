// SPDX-License-Identifier: Apache-2.0
//
// Pictures drawn for the hard scenes: lines, graticules, stars far brighter than white. Linear light.

#pragma once

#include "pipeline/image/picture.h"

namespace lensplane {

/// Black lines on white, straight, round and radial, 1 to 3 of `frame` pixels wide; `width` x `height`
/// texels, as wide as a frame of `frame` pixels. Without `paper` the ground is clear and the lines are red.
Picture line_art(int width, int height, int frame, bool paper = true);

/// A globe of smooth colours with a graticule every 15 degrees up to both poles.
Picture graticule(int width, int height);

/// A dark lat-long sky with a faint band and stars whose brightest texels are between 1 and 300.
Picture bright_stars(int width, int height);

/// One colour.
Picture plain_picture(int width, int height, const Rgba& colour);

}  // namespace lensplane
