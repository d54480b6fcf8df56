// SPDX-License-Identifier: Apache-2.0
//
// Stars as light on the film: every image of every star, with its colour and brightness.
//
// The light of an image is what the pixels that it is drawn on add up to in the middle of the frame
// (star_dot.h says elsewhere). It depends on the star alone, and on by how much it is magnified: not on the
// field of view or the number of pixels. So a star's dot is as bright at any resolution, as it is as wide in
// pixels; a picture of more pixels shows finer dots.

#pragma once

#include <vector>

#include "pipeline/composite/star_colour.h"
#include "pipeline/image/star_catalogue.h"
#include "src/point_images.h"

namespace lensplane {

/// Luminance that the pixels of a star of V = 0 add up to, at exposure 0. Drawn 0.6 pixels wide, its
/// brightest pixel has up to a third of it: white by far. A star of V = 6 has 0.02 there: just visible.
inline constexpr double kLightOfMagnitudeZero = 16;

/// A catalogue, ready to be looked at from many frames.
struct StarField {
  DirectionIndex index;
  std::vector<Rgb> light;  // of every star, unmagnified, linear ACEScg
};

/// What StarField::light holds of a catalogue. `exposure` in stops: each one doubles all light.
std::vector<Rgb> star_light(const std::vector<Star>& stars, double exposure = 0);

/// A catalogue with that light.
StarField star_field(const std::vector<Star>& stars, double exposure = 0);

struct StarImage {
  std::size_t star = 0;      // its number in the catalogue
  FilmPosition film{0, 0};   // pixels
  double magnification = 0;  // signed
  Rgb light{0, 0, 0};        // magnified; in the space of StarField::light
};

/// Every image of the field's stars that the tracer's camera sees beyond all masses. What surfaces hide of
/// them is for the caller to take off. The number of threads changes nothing.
std::vector<StarImage> find_star_images(const Tracer& tracer, const StarField& field,
                                        const ImageSearch& search = {});

}  // namespace lensplane
