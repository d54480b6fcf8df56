// SPDX-License-Identifier: Apache-2.0
//
// Filtering by the Jacobian: what a pixel of the film sees of a pyramid of texels.
//
// The result is the integral of the pixel filter, mapped by the Jacobian, over the picture as a surface
// between its texels: close_filter.h for footprints whose shorter axis is about a texel and less,
// elliptical_filter.h for larger ones. The elliptical filter works on the coarsest level whose texels the
// shorter axis spans. Where a level's own filter has widened the picture already the ellipse is made the
// smaller, so that the whole has the right second moments and no seam shows between levels.

#pragma once

#include "pipeline/composite/footprint.h"
#include "pipeline/composite/texels.h"

namespace lensplane {

/// No lookup of a whole pixel visits many more texels than this, one of a part of a pixel that part of them;
/// ellipses that are larger are looked up in coarser levels than their shorter axis asks for. At 100:1 that
/// is never.
inline constexpr double kMostTexels = 4096;

/// The mean of the texels at (s, t) under `footprint`. Always finite when the texels are: what is no number
/// in the footprint or in (s, t) sees the mean of the picture.
Rgba filtered_texels(Texels& texels, TextureCoordinates st, const Footprint& footprint);

}  // namespace lensplane
