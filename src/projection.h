// SPDX-License-Identifier: Apache-2.0
//
// Projections: which direction a film position looks in, and back.
//
// Everything works in the camera's own axes (looking along -z, +x right, +y up). Templates over the number
// type are instantiated for `double` and for `Dual`, whose derivatives are by the film position.

#pragma once

#include <optional>

#include "src/dual.h"
#include "src/scene.h"

namespace lensplane {

/// A position on the film in pixels: x right, y down, (0.5, 0.5) the centre of the upper left pixel.
struct FilmPosition {
  double x, y;
};

/// The same, with numbers of either kind.
template <class Number>
struct FilmPoint {
  Number x, y;
};

/// Does light reach the film position? False outside a fisheye's circle, which overscan does not widen.
bool sees(const Camera& camera, FilmPosition film);

/// Radians across a pixel in the middle of the frame; of a lat-long camera, along its equator.
double pixel_angle(const Camera& camera);

/// Unit vector in which the film position looks, with exact derivatives per pixel.
///   perspective  (a, b, -1)/|...|, a and b the slopes of slopes_from_pixel
///   lat-long     (sin lon cos lat, sin lat, -cos lon cos lat), lon = (x/width - 1/2) 2 pi,
///                lat = (1/2 - y/height) pi; positions beyond the frame go on round the sphere and over its
///                poles
///   fisheye      fov/size radians from -z for every pixel from the centre, size = min(width, height)
/// Has no meaning where the camera does not see.
template <class Number>
Vector<Number> direction_from_film(const Camera& camera, FilmPosition film);

/// Where a direction of any length lies on the film. Inverse of direction_from_film; x of a lat-long camera
/// is in [0, width). Nothing for the zero vector, for z >= 0 with a perspective camera, and for straight
/// backwards (+z) with a fisheye. At a pole of a lat-long camera, where every x is right, x is width/2 and
/// the derivatives, which do not exist, are 0.
template <class Number>
std::optional<FilmPoint<Number>> film_from_direction(const Camera& camera, const Vector<Number>& direction);

/// Relative error of the distance by which film_moved moves, for directions of about the same length, times
/// the enlargement of the film there where it grows without limit: 1/cos(lat) towards the poles of a lat-long
/// camera, theta/sin(theta) towards straight backwards of a fisheye.
inline constexpr double kFilmShiftError = 1e-15;

/// Where `last` lies on the film, when `first` is the direction in which `film` looks: `film` plus the
/// difference of their film positions, formed from the difference of the directions. So it is `film`, bit for
/// bit, where both are equal, and right to kFilmShiftError for however narrow a view. Nothing where
/// film_from_direction has nothing.
///
/// x of a lat-long camera is brought into [0, width), except where both are equal. Where `film` lies beyond a
/// pole so does the result: direction_from_film has it look along `last`.
template <class Number>
std::optional<FilmPoint<Number>> film_moved(const Camera& camera, FilmPosition film,
                                            const Vector<Number>& first, const Vector<Number>& last);

/// The direction (right, up, -1) of a perspective camera, not normalised. Differences of slopes stay exact
/// for the narrowest fields of view.
struct Slopes {
  double right, up;
};

/// Slope across one pixel of a perspective camera: 2 tan(fov/2)/width.
double slope_per_pixel(const Camera& camera);

/// The slopes in which the film position looks.
Slopes slopes_from_pixel(const Camera& camera, FilmPosition film);

/// The same with slope_per_pixel() at hand, whose tangent takes longer than all the rest.
Slopes slopes_from_pixel(const Camera& camera, FilmPosition film, double slope);

/// Where a direction with these slopes meets the film. Inverse of slopes_from_pixel.
FilmPosition pixel_from_slopes(const Camera& camera, Slopes slopes);

/// Unit vector for a film position of a perspective camera.
Vec3 direction_from_pixel(const Camera& camera, FilmPosition film);

}  // namespace lensplane
