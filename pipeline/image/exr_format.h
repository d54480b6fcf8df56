// SPDX-License-Identifier: Apache-2.0
//
// What can be chosen about an EXR file, and the kinds of values that its header holds.

#pragma once

#include <array>

namespace lensplane {

enum class PixelType { Half, Float };
enum class ExrCompression { None, Rle, Zips, Zip, Piz, Pxr24, B44, B44a, Dwaa, Dwab };

/// A whole-number ratio, as frame rates are exchanged: 24/1, 24000/1001.
struct Rational {
  int numerator = 0;
  int denominator = 1;
};

/// Primaries and white of a colour space: CIE xy of red, green, blue, white.
using Chromaticities = std::array<std::array<float, 2>, 4>;

struct ExrFormat {
  PixelType type = PixelType::Half;
  ExrCompression compression = ExrCompression::Zip;
};

}  // namespace lensplane
