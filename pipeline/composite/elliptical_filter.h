// SPDX-License-Identifier: Apache-2.0
//
// The elliptical weighted average: texels of one level under a Gaussian of any axes and direction.
//
// The ellipse is walked row by row, so that the cost is its area, however long and slanted it is. The
// Gaussian ends as gaussian_window.h says. Paul S. Heckbert, Fundamentals of Texture Mapping and Image
// Warping, Berkeley 1989.

#pragma once

#include "pipeline/composite/footprint.h"
#include "pipeline/composite/texels.h"

namespace lensplane {

/// How many texels an ellipse holds per unit of the product of its standard deviations.
inline constexpr double kTexelsPerEllipse = 38;

/// Mean of a level's texels around (x, y), counted in texels from the centre of the first. The shorter axis
/// of `covariance` has to be at least kSmallestVariance, or the pattern of the texels shows.
Rgba elliptical_mean(Texels& texels, int level, double x, double y, const Covariance& covariance);

inline constexpr double kSmallestVariance = 0.4;

}  // namespace lensplane
