// SPDX-License-Identifier: Apache-2.0
//
// The dot that a star is seen as: a Gaussian, in views all around on the sky, in perspective on the film.
//
// Lat-long pictures and fisheyes stand for the sky, and other pictures are made from them. In them a star is
// as wide on the sky everywhere, and what the pixels of its dot add up to, each times its solid angle, is the
// same wherever it lies: towards the poles of a lat-long picture dots grow wide, towards the rim of a fisheye
// long. A perspective picture is looked at as it is: its dots are alike on the film, and a star that drifts
// across it keeps its look.

#pragma once

#include "pipeline/composite/star_images.h"

namespace lensplane {

/// How a point is seen.
struct PointSpread {
  double sigma_px = 0.6;  // standard deviation in pixels of the frame's middle, > 0 and up to 7

  /// Pixels from its middle beyond which a dot has no light, wherever the camera sees it:
  /// ImageSearch::margin_px should be as large.
  double reach_px(const Camera& camera) const;
};

/// Standard deviations on both sides of a dot's middle within which it is drawn; 1e-4 of its light lies
/// beyond.
inline constexpr double kDotReach = 4;

/// Closer to a pole of a lat-long film than so many pixels a dot is no ellipse: see polar_dot.h.
inline constexpr double kPolarPixels = 40;
bool is_polar(const Camera& camera, FilmPosition film);

/// The standard deviation of dots on the sky, in radians, and the solid angle of a pixel in the frame's
/// middle, where an image's light is what the pixels add up to.
struct SkySpread {
  double sigma, pixel;
};
SkySpread sky_spread(const Camera& camera, const PointSpread& spread);

/// A Gaussian on the film, in pixels.
struct StarDot {
  FilmPosition film{0, 0};
  double xx = 0, xy = 0, yy = 0;  // variances and covariance
  Rgb light{0, 0, 0};             // what its pixels add up to
};
StarDot dot_of(const StarImage& image, const Camera& camera, const SkySpread& sky);

}  // namespace lensplane
