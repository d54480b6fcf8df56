// SPDX-License-Identifier: Apache-2.0
//
// How much of a texture a pixel of the film sees: the pixel filter, and its image under the Jacobian.
//
// A pixel is filtered by a Gaussian of the film; the Jacobian maps it to an ellipse in the texture, which is
// held as the covariance of that Gaussian. Variances of filters one after the other add up.
//
// A picture has been filtered by its own pixels already, as the film is: by a Gaussian of kPixelSigma texels.
// So much is taken off the ellipse along both of its axes, as far as there is so much. A picture that is
// shown as large as it is comes back as it is; of one that is much finer than the film, next to nothing is
// taken off.

#pragma once

#include "src/surfaces.h"

namespace lensplane {

/// Standard deviation of the pixel filter in pixels of the film. Wider is blurred, narrower flickers: of what
/// repeats in two pixels it leaves 37 %, of what repeats in one pixel and cannot be shown 2 %.
inline constexpr double kPixelSigma = 0.45;

/// The derivatives of (s, t) by the film position, per pixel.
struct Footprint {
  double ds_dx = 0;
  double ds_dy = 0;
  double dt_dx = 0;
  double dt_dy = 0;
  double scale = 1;  // the filter's width in units of kPixelSigma: less than 1 for rays within a pixel, 0 for
                     // a point
  double x = 0, y = 0;  // of a ray within a pixel: from the pixel's centre to the ray, in pixels of the film
};

bool is_finite(const Footprint& footprint);

/// A Gaussian in texels of some level, columns to the right, rows down.
struct Covariance {
  double xx = 0;
  double xy = 0;
  double yy = 0;
};

/// The pixel filter in texels of a picture of `width` x `height`, `scale` left out of account.
Covariance covariance_in_texels(const Footprint& footprint, int width, int height);

/// The variances along the axes of an ellipse, neither of them negative.
struct AxisVariances {
  double major = 0;
  double minor = 0;
};

AxisVariances variances_of(const Covariance& covariance);

/// The same with the direction of the longer one.
struct Axes : AxisVariances {
  double x = 1;  // unit vector
  double y = 0;
};

Axes axes_of(const Covariance& covariance);

/// What a lookup filters by, in texels.
struct TexelFilter {
  Covariance covariance;
  AxisVariances axes;     // of the covariance
  double dx = 0, dy = 0;  // from the place that the ray sees to the middle of the filter
};

/// The pixel filter less the picture's own, `scale` taken into account. What rays within a pixel see lies as
/// far apart as that filter is wide: their places are drawn together towards what the pixel's centre sees, so
/// that the sum of rays is the filter of the single ray.
TexelFilter texel_filter(const Footprint& footprint, int width, int height);

/// The variance of a picture's own filter, in texels. A little more is taken off than it has, so that the
/// rounding of a map does not blur.
inline constexpr double kOwnVariance = 1.02 * kPixelSigma * kPixelSigma;

/// What of it is taken off an axis along which the pixel filter has this variance in texels: all where the
/// picture has as many pixels as the film, less where it is finer, and nothing from twice as many on, where
/// the film's filter alone says what a pixel sees.
double own_variance(double variance);

/// The same with both variances at least `least` > 0, whatever they were: what is left of an ellipse when
/// another's variance has been taken off may be less than nothing along an axis.
Covariance widened(const Covariance& covariance, double least);

}  // namespace lensplane
