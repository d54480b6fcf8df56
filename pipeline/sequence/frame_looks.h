// SPDX-License-Identifier: Apache-2.0
//
// What the surfaces of a shot's scene look like at an instant: their images, the light on them, and the
// shadows.

#pragma once

#include <vector>

#include "pipeline/composite/layering.h"
#include "pipeline/sequence/texture_store.h"

namespace lensplane {

/// The looks of all surfaces of `scene`, which is the shot's at `time`, with the images of `frame`. Throws
/// Failure (BadInput) when an image cannot be read.
std::vector<SurfaceLook> looks_at(const Shot& shot, const Scene& scene, TextureStore& textures, int frame,
                                  double time);

}  // namespace lensplane
