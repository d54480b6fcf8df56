// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/thin_light.h"

namespace lensplane {

ThinLight::ThinLight(double left, double top, int width, int height)
    : left_(left),
      top_(top),
      width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

double ThinLight::rest(int column, int row) const {
  return empty() ? 1.0 : std::max(0.0, 1.0 - at(column, row).weight);
}

Rgba ThinLight::over(int column, int row, const Rgba& background) const {
  if (empty()) return background;
  const Pixel& pixel = at(column, row);
  const double whole =
      std::max(1.0, pixel.weight);  // a pixel that is covered all over may have a little more
  const auto by = static_cast<float>(1.0 / whole), rest = static_cast<float>(this->rest(column, row));
  Rgba colour;
  for (std::size_t c = 0; c < 4; ++c) colour[c] = by * pixel.colour[c] + rest * background[c];
  return colour;
}

}  // namespace lensplane
