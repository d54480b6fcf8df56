// SPDX-License-Identifier: Apache-2.0
//
// Footprints at the poles of a globe, where (s, t) are bent too much for an ellipse.
//
// Within a few pixels of a pole the longitude turns within a footprint. There the pixel filter is the sum of
// narrower ones, laid out on the plane that touches the globe at the pole (colatitude as the distance from
// it), on which the picture is as smooth as anywhere; each of them is small enough to be an ellipse in (s,
// t).

#pragma once

#include <cmath>

#include "pipeline/composite/footprint.h"

namespace lensplane {

/// Whether the pixel filter at (s, t) spans so much longitude near a pole that an ellipse does not do.
bool bends_around_pole(TextureCoordinates st, const Footprint& footprint);

/// The parts are Gaussians this many times as wide as the pixel filter.
inline constexpr double kPolarPartSigma = 1.0 / 3;

struct PolarPart {
  TextureCoordinates st;
  Footprint footprint;
};

/// The part whose centre lies at (x, y) standard deviations of the pixel filter.
PolarPart polar_part(TextureCoordinates st, const Footprint& footprint, double x, double y);

/// Calls `use` with the weight, the position and the footprint of each part.
template <class Use>
void for_each_polar_part(TextureCoordinates st, const Footprint& footprint, Use use) {
  constexpr int kLast = 5;
  constexpr double kStep = 0.5;  // at most 1.5 times a part's width, or the lattice would show
  constexpr double kLatticeVariance = 1 - kPolarPartSigma * kPolarPartSigma;
  for (int j = -kLast; j <= kLast; ++j) {
    for (int i = -kLast; i <= kLast; ++i) {
      const double weight = std::exp(-(i * i + j * j) * kStep * kStep / (2 * kLatticeVariance));
      use(weight, polar_part(st, footprint, i * kStep, j * kStep));
    }
  }
}

}  // namespace lensplane
