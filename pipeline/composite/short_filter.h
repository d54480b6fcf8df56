// SPDX-License-Identifier: Apache-2.0
//
// The filter for ellipses of about a texel and less: the Gaussian's integral over the cubic surface between
// texels.
//
// What the two axes of the texels do not share is the product of two kernels. A Gaussian that leans is the
// sum of such products along a line, at the places that Gauss and Hermite give for it.

#pragma once

#include "pipeline/composite/footprint.h"
#include "pipeline/composite/texels.h"

namespace lensplane {

/// Of the largest variance along columns and rows that the filter is made for, in texels.
inline constexpr double kLargestShortVariance = 0.9;

/// What of the variances is due to both axes alike, that is, to the Gaussian's leaning: |correlation| times
/// their sum. 0 along the axes.
double leaning(const Covariance& pixel);
inline constexpr double kLargestLeaning = 1.2;

/// The mean of the finest level's surface around (x, y), counted in texels from the centre of the first.
Rgba short_mean(Texels& texels, double x, double y, const Covariance& pixel);

}  // namespace lensplane
