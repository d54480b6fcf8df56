// SPDX-License-Identifier: Apache-2.0
//
// Projections: which direction a film position looks in, and back.
//
// Both work in the camera's own axes (looking along -z). A direction is given by its slopes, the tangents
// (right, up) at unit depth, because differences of slopes stay exact for the narrowest fields of view.

#pragma once

#include "src/scene.h"

namespace lensplane {

/// A position on the film in pixels: x right, y down, (0.5, 0.5) the centre of the upper left pixel.
struct FilmPosition {
  double x, y;
};

/// The direction (right, up, -1), not normalised.
struct Slopes {
  double right, up;
};

/// Slope across one pixel of a perspective camera: 2 tan(fov/2)/width.
double slope_per_pixel(const Camera& camera);

/// The slopes in which the film position looks.
Slopes slopes_from_pixel(const Camera& camera, FilmPosition film);

/// Where a direction with these slopes meets the film. Inverse of slopes_from_pixel.
FilmPosition pixel_from_slopes(const Camera& camera, Slopes slopes);

/// Unit vector in camera axes for a film position.
Vec3 direction_from_pixel(const Camera& camera, FilmPosition film);

}  // namespace lensplane
