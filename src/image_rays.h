// SPDX-License-Identifier: Apache-2.0
//
// Film positions that cover the image of a body within a square of the film, however small or thin it is.
//
// A thin annulus is followed along rings of it, from where they enter the square to where they leave it; all
// else is cut into chords, in equal steps of the angle under which they lie on the outer ellipse, for which
// the midpoint rule is exact.

#pragma once

#include <vector>

#include "src/body_image.h"

namespace lensplane {

/// A square piece of the film; its left and upper sides belong to it.
struct FilmSquare {
  FilmPosition corner;  // upper left
  double size;          // pixels

  FilmPosition centre() const { return {corner.x + size / 2, corner.y + size / 2}; }
  bool holds(FilmPosition film) const {
    return film.x >= corner.x && film.x < corner.x + size && film.y >= corner.y && film.y < corner.y + size;
  }
};

/// A film position that stands for a piece of an image.
struct ImageRay {
  FilmPosition film;
  double area;    // of the piece, square pixels
  double spread;  // of the piece along its longer side, as a standard deviation, pixels
};

/// Film positions that cover the image within a square evenly: their areas add up to its area to 1 %, and
/// over all squares more exactly. None where it does not reach into the square.
std::vector<ImageRay> rays_over(const BodyImage& image, const FilmSquare& square);

}  // namespace lensplane
