// SPDX-License-Identifier: Apache-2.0
//
// How much of a texture a pixel of the film sees: the pixel filter, and its image under the Jacobian.
//
// A pixel is filtered by a Gaussian of the film; the Jacobian maps it to an ellipse in the texture, which is
// held as the covariance of that Gaussian. Variances of filters one after the other add up.

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
  double spared = 0;  // variance in texels that is taken off both axes: by so much the picture has been
                      // filtered already
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

/// The ellipse with these axes.
Covariance covariance_from(const Axes& axes);

/// The same with both variances at least `least` > 0, whatever they were: what is left of an ellipse when
/// another's variance has been taken off may be less than nothing along an axis.
Covariance widened(const Covariance& covariance, double least);

}  // namespace lensplane
