// SPDX-License-Identifier: Apache-2.0
//
// What every projection has to know, in plain numbers with closed derivatives; for projection.cpp alone.
//
// Adding a projection means adding its three functions here and its line to the table of projection.cpp.

#pragma once

#include <cmath>
#include <optional>

#include "src/projection.h"

namespace lensplane {

/// The unit vector in which a film position looks, and its derivatives per pixel.
struct FilmRay {
  Vec3 direction, by_x, by_y;
};

/// Where a direction lies on the film, and the gradients of x and y by the direction's components.
struct FilmSpot {
  FilmPosition film;
  Vec3 x_gradient, y_gradient;
};

/// Where film_moved moves to. `y_sense` is -1 where film y runs against that of FilmSpot: beyond a pole.
struct FilmStep {
  FilmPosition film;
  double y_sense = 1;
};

namespace perspective {
FilmRay ray(const Camera& camera, FilmPosition film);
std::optional<FilmSpot> spot(const Camera& camera, const Vec3& direction);
std::optional<FilmStep> step(const Camera& camera, FilmPosition film, const Vec3& first, const Vec3& last);
}  // namespace perspective

namespace latlong {
FilmRay ray(const Camera& camera, FilmPosition film);
std::optional<FilmSpot> spot(const Camera& camera, const Vec3& direction);
std::optional<FilmStep> step(const Camera& camera, FilmPosition film, const Vec3& first, const Vec3& last);
}  // namespace latlong

namespace fisheye {
FilmRay ray(const Camera& camera, FilmPosition film);
std::optional<FilmSpot> spot(const Camera& camera, const Vec3& direction);
std::optional<FilmStep> step(const Camera& camera, FilmPosition film, const Vec3& first, const Vec3& last);
}  // namespace fisheye

using Vec2 = Imath::V2d;

/// Radians, from +x towards +y, by which a vector turns when `change` is added to it. The cross product is
/// that of the change, so that small turns stay exact. 0 for vectors of no length.
inline double turn(const Vec2& from, const Vec2& change) {
  return std::atan2(from.cross(change), from.dot(from + change));
}

/// By how much a vector becomes longer when `change` is added to it, exact for small changes.
inline double growth(const Vec2& from, const Vec2& change) {
  const Vec2 to = from + change;
  const double lengths = std::hypot(from.x, from.y) + std::hypot(to.x, to.y);
  return lengths > 0 ? change.dot(from + to) / lengths : 0.0;
}

/// Nearer to an axis than this, in radians, a direction lies on it.
inline constexpr double kOnAxis = 1e-100;

}  // namespace lensplane
