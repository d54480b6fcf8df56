// SPDX-License-Identifier: Apache-2.0
//
// Quantities with units: "1.989e31 kg", "3 deg". Units end here; behind this border everything is in metres,
// radians and geometric mass.

#pragma once

#include <string>
#include <string_view>

namespace lensplane {

enum class Dimension {
  Number,  // no unit
  Length,  // metres
  Angle,   // radians
  Mass,    // geometric mass G M / c^2, metres
  Pixels,  // pixels of the output frame
  Share,   // of a whole
  Time,    // seconds
};

/// "a length", "an angle", ...
std::string_view noun_of(Dimension dimension);

/// The units of a dimension, for error messages: "m, km, AU, ...".
std::string units_of(Dimension dimension);

/// Beyond any universe, and small enough for squares of lengths.
inline constexpr double kLargestQuantity = 1e100;

/// The value of `text` in the units given above, or what is wrong with it.
struct ParsedQuantity {
  double value = 0;
  std::string error;  // empty when the value is good
};

/// Reads a finite number and, except for Dimension::Number, a unit. Infinities, NaN and numbers too small for
/// a double's full precision are errors.
ParsedQuantity parse_quantity(std::string_view text, Dimension dimension);

}  // namespace lensplane
