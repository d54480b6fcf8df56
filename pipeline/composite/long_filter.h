// SPDX-License-Identifier: Apache-2.0
//
// The filter for ellipses that are longer than a texel, but not much wider.
//
// The ellipse is taken apart by rows: what all texels of one row weigh together, a Gaussian, and how that is
// spread within the row, the cubic surface under a Gaussian about a middle that moves from row to row. Where
// an ellipse is too long within a row for a kernel it is taken apart by columns instead.

#pragma once

#include "pipeline/composite/footprint.h"
#include "pipeline/composite/texels.h"

namespace lensplane {

/// Standard deviation of the longer axis that the filter can hold, in texels.
inline constexpr double kLongestSigma = 100;

/// Of the largest variance along columns and rows that the filter is made for, in texels: a Gaussian of less
/// is too narrow to be a sum over rows.
inline constexpr double kSmallestLongVariance = 0.25;

/// The mean of the finest level's surface around (x, y), counted in texels from the centre of the first.
Rgba long_mean(Texels& texels, double x, double y, const Covariance& pixel);

}  // namespace lensplane
