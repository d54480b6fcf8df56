// SPDX-License-Identifier: Apache-2.0
//
// A rectangle of the film, and every place in it where a direction is seen when nothing is lensed.

#pragma once

#include <vector>

#include "src/projection.h"

namespace lensplane {

/// In pixels; `left` and `top` belong to it, `right` and `bottom` do not.
struct FilmArea {
  double left, top, right, bottom;

  bool contains(FilmPosition film) const {
    return film.x >= left && film.x < right && film.y >= top && film.y < bottom;
  }
};

/// The camera's film, overscan included, and `margin` pixels more on every side.
FilmArea film_area(const Camera& camera, double margin);

/// Where in the area a direction in camera axes is seen, from the left. More than one place where a lat-long
/// film goes on round the sphere or over its poles, none where the camera does not see.
std::vector<FilmPosition> films_of_direction(const Camera& camera, const FilmArea& area,
                                             const Vec3& direction);

}  // namespace lensplane
