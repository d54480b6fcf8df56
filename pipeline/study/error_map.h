// SPDX-License-Identifier: Apache-2.0
//
// Where on the film a trace is off, and by how much, in false colours.

#pragma once

#include <string>
#include <vector>

#include "pipeline/image/picture.h"
#include "src/accuracy.h"
#include "src/film_grid.h"

namespace lensplane {

/// The range of the colours, in pixels; what lies beyond has the colour of the end.
inline constexpr double kLeastShownPx = 1e-6;
inline constexpr double kMostShownPx = 1e3;

/// The colour of an error, as displays show it (sRGB, 0 to 1): from dark blue over red to light yellow,
/// lighter for more.
Rgba error_colour(double px);

/// One pixel for each of the grid's: error_colour(), grey where there is nothing to compare, cyan where only
/// one of both traces sees something.
Picture error_map(const FilmGrid& grid, const std::vector<RayError>& errors);

/// The same as a PNG in a data URI. Throws Failure (BadInput) when the library that writes it is missing.
std::string data_uri_of(const Picture& picture);

/// The legend, an SVG element.
std::string error_legend();

}  // namespace lensplane
