// SPDX-License-Identifier: Apache-2.0
//
// Where on the film a sphere or a ring is seen, as far as the light of one film position tells: an ellipse,
// or a piece of an annulus under a linear map. So it is known of bodies that are smaller than a pixel, and of
// rings that are thinner.
//
// What the map says of film positions farther away is off by its second derivatives.

#pragma once

#include <optional>

#include "src/film_cell.h"
#include "src/passing_light.h"

namespace lensplane {

/// By how much a map from the film stretches, along its principal axes.
struct Stretching {
  double most = 0, least = 0;  // lengths to which it takes a pixel
  double x = 1, y = 0;         // the film direction of the larger one, a unit vector
};
Stretching stretching_of(const FilmJacobian& map);

/// How the light of a film position passes a body.
struct Approach {
  double gap;              // pixels to the body's image, at least; 0 on it
  double thickness;        // of the image where it is nearest, across, pixels
  double least_thickness;  // no part of the image is thinner, pixels
  FilmPosition shift;      // pixels to about where the image is nearest
};

/// `body`: a sphere or a ring, in camera axes. `turn`: radians by which light may run differently elsewhere;
/// so much nearer to edge-on a ring is taken to be seen for its least thickness. Nothing when the body does
/// not lie on the light's way, or has no image.
std::optional<Approach> approach(const Surface& body, const LightLine& light, double turn);

/// Film positions whose light meets the body: those for which the point x(film) = x(at) + J (film - at) of a
/// plane lies in an annulus round the origin.
struct BodyImage {
  FilmPosition at{0, 0};
  double u = 0, v = 0;     // metres
  FilmJacobian by_film{};  // metres per pixel
  double inner = 0;        // metres
  double outer = 0;        // metres

  /// Is the film position on the image, or no farther from it than `slack` pixels at least?
  bool holds(FilmPosition film, double slack = 0) const;
};

/// `light` is that of `at`. Nothing for a ring whose plane it does not come to.
std::optional<BodyImage> body_image(const Surface& body, const LightLine& light, FilmPosition at);

/// How far apart on the film two images take the film position `film` of the one to be, in pixels.
double apart(const BodyImage& a, const BodyImage& b, FilmPosition film);

}  // namespace lensplane
