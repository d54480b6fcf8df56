// SPDX-License-Identifier: Apache-2.0
//
// The filter for footprints of about a texel and less: the picture is a surface between its texels, and the
// pixel filter's integral over that surface is taken exactly.
//
// Texels are joined by a bilinear surface (weights: the triangle), or by a cubic B-spline where the picture
// is magnified so much that the bilinear surface's creases would show; anything between the two is allowed,
// for each axis. The Gaussian is a round one, moved along the longer axis of the ellipse.

#pragma once

#include "pipeline/composite/footprint.h"
#include "pipeline/composite/texels.h"

namespace lensplane {

/// The share of the cubic surface along columns and rows, 0 to 1.
struct Smoothness {
  double x = 0;
  double y = 0;
};

/// Standard deviation of the shorter axis that the filter is made for, in texels.
inline constexpr double kLargestCloseSigma = 0.6;

/// The mean of the finest level's surface around (x, y), counted in texels from the centre of the first.
/// `axes`: the pixel filter; `minor` at most the square of kLargestCloseSigma.
Rgba close_mean(Texels& texels, double x, double y, const Axes& axes, Smoothness smoothness);

}  // namespace lensplane
