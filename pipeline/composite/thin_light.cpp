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

SeenLight ThinLight::over(int column, int row, const SeenLight& background) const {
  if (empty()) return background;
  const Pixel& pixel = at(column, row);
  const double whole =
      std::max(1.0, pixel.weight);  // a pixel that is covered all over may have a little more
  const auto by = static_cast<float>(1.0 / whole), left = static_cast<float>(rest(column, row));
  SeenLight seen{{}, by * pixel.seen.shadow + left * background.shadow};
  for (std::size_t c = 0; c < 4; ++c)
    seen.colour[c] = by * pixel.seen.colour[c] + left * background.colour[c];
  return seen;
}

}  // namespace lensplane
