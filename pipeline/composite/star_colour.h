// SPDX-License-Identifier: Apache-2.0
//
// The colour of stars: that of a blackbody whose temperature follows from B - V.
//
// Planck's spectrum is weighed with the CIE 1931 2 degree colour matching functions (the fits of Wyman, Sloan
// and Shirley, JCGT 2 (2013) 2, which move chromaticities of blackbodies by up to 0.002) and taken to ACEScg.
// White is adapted from D65 to that of ACES by Bradford's matrix, as colour management adapts pictures whose
// white is D65: so a star of 6500 K is neutral beside them.

#pragma once

#include <array>

namespace lensplane {

/// Red, green and blue of linear light.
using Rgb = std::array<double, 3>;

/// Kelvin, from F. Ballesteros, EPL 97 (2012) 34008; B - V above -0.67.
double temperature_from_b_minus_v(double b_minus_v);

/// Chromaticity x, y (CIE 1931) of a blackbody.
struct Chromaticity {
  double x, y;
};
Chromaticity blackbody_chromaticity(double kelvin);

/// Light of a chromaticity in ACEScg, with luminance 1. None is negative: what lies outside of ACEScg is
/// moved to its edge.
Rgb acescg_from_chromaticity(Chromaticity chromaticity);

/// The colour of a star in ACEScg, with luminance 1.
Rgb star_colour(double b_minus_v);

}  // namespace lensplane
