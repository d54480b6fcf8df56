// SPDX-License-Identifier: Apache-2.0
//
// Looking a picture up over the footprint of a pixel.

#pragma once

#include "pipeline/composite/texture.h"

namespace lensplane {

/// What a pixel covers of a picture: derivatives of (s, t) by the film position, per pixel; x to the right, y
/// down.
struct Footprint {
  double ds_dx = 0, ds_dy = 0, dt_dx = 0, dt_dy = 0;
};

/// The picture at (s, t), averaged over the footprint.
inline Rgba filtered(const Texture& texture, TextureCoordinates st, const Footprint&) {
  return texture.lookup(st);
}

}  // namespace lensplane
