// SPDX-License-Identifier: Apache-2.0
//
// What picture quality is measured on: plates behind three masses.

#pragma once

#include <string>

#include "pipeline/composite/layering.h"
#include "pipeline/image/picture.h"
#include "src/scene.h"

namespace lensplane {

inline constexpr int kFrameWidth = 640;
inline constexpr int kFrameHeight = 360;

/// A plate at infinity behind three masses, whose Einstein rings are some 50 pixels in radius. `shift`:
/// pixels that the first mass has moved to the right.
Scene scene_behind_three_masses(double shift = 0);

/// Rings about the centre that become finer outwards, up to one period in two pixels at the shorter edge.
Picture zone_plate();

/// Black and white fields of 12 pixels.
Picture checker();

/// A piece of an image file as it is drawn at the frame's size, in linear light, scaled so that its brightest
/// pixel is 1.
Picture piece_of(const std::string& file, int left, int top);

}  // namespace lensplane
