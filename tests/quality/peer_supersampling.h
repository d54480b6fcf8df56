// SPDX-License-Identifier: Apache-2.0
//
// A peer: warping by supersampling, as Natron's STMap does.
//
// The derivatives of the map are differences of a pixel's two neighbours. Where the map shrinks the plate, a
// pixel is the plain mean of points spread over the parallelogram that the derivatives span, along each side
// 3, 9, 27 or 81 of them, whichever is nearest to its length in texels; each is a bilinear lookup. Elsewhere
// there is one lookup, by a smooth curve from texel to texel.

#pragma once

#include "pipeline/composite/texel_place.h"
#include "pipeline/image/picture.h"
#include "src/lens_map.h"

namespace lensplane {

/// `plate` as seen through the map, premultiplied by its coverage.
Picture warped_by_supersampling(const LensMap& map, const Picture& plate, Wrap edge);

}  // namespace lensplane
