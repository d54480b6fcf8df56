// SPDX-License-Identifier: Apache-2.0
//
// A peer: warping by an area filter whose size comes from the map alone, as Gaffer's warp nodes do.
//
// The derivatives of the map are one-sided differences; of the two sides of a pixel the smaller counts, for
// each coordinate by itself, so that a seam blurs nothing. Around the point that the map names, texels are
// weighted by a filter over the parallelogram that the derivatives span, which is at least a texel wide.

#pragma once

#include "pipeline/composite/texel_place.h"
#include "pipeline/image/picture.h"
#include "src/lens_map.h"

namespace lensplane {

/// `plate` as seen through the map, premultiplied by its coverage.
Picture warped_by_area(const LensMap& map, const Picture& plate, Wrap edge);

}  // namespace lensplane
