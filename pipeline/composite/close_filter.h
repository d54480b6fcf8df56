// SPDX-License-Identifier: Apache-2.0
//
// The filter for footprints whose shorter axis is about a texel and less: the picture is a surface between
// its texels, and the pixel filter's integral over that surface is taken, by short_filter.h and
// long_filter.h.
//
// The surface is Catmull-Rom's cubic (surface_kernel.h), at every magnification.

#pragma once

#include "pipeline/composite/footprint.h"
#include "pipeline/composite/texels.h"

namespace lensplane {

/// Variance of the shorter axis that the filter is made for, in texels.
inline constexpr double kLargestCloseVariance = 0.5;

/// The mean of the finest level's surface around (x, y), counted in texels from the centre of the first.
/// `pixel`: a Gaussian whose axes are within kLargestCloseVariance and kLongestSigma.
Rgba close_mean(Texels& texels, double x, double y, const Covariance& pixel);

}  // namespace lensplane
