// SPDX-License-Identifier: Apache-2.0
//
// The filter for footprints whose shorter axis is about a texel and less: the picture is a surface between
// its texels, and the pixel filter's integral over that surface is taken.
//
// Texels are joined by a bilinear surface (weights: the triangle), or by a cubic B-spline where the picture
// is magnified so much that the bilinear surface's creases would show; anything between the two is allowed,
// for each axis. The ellipse is taken apart by rows: what all texels of one row weigh together, and how that
// is spread within the row, about a middle that moves from row to row. Both are exact up to second moments,
// and so is the whole. Where an ellipse is too long within a row for a kernel it is taken apart by columns
// instead.

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
inline constexpr double kLargestCloseSigma = 0.7;

/// Standard deviation of the longer axis that it can hold, in texels.
inline constexpr double kLongestCloseSigma = 100;

/// The mean of the finest level's surface around (x, y), counted in texels from the centre of the first.
/// `pixel`: the pixel filter, within the two limits.
Rgba close_mean(Texels& texels, double x, double y, const Covariance& pixel, Smoothness smoothness);

}  // namespace lensplane
