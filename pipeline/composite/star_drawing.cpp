// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/star_drawing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/composite/polar_dot.h"

namespace lensplane {
namespace {

/// Rows that one thread draws.
constexpr int kBand = 32;

/// Lines along which a dot that leans is drawn in a row of pixels.
constexpr int kLines = 4;

/// Phi, the integral of the normal distribution, from a table: right to 1e-6.
class CumulativeNormal {
 public:
  CumulativeNormal() {
    for (int i = 0; i <= kSteps + 1; ++i) {
      values_[static_cast<std::size_t>(i)] = 0.5 * std::erfc((kEnd - i / kPerUnit) / std::numbers::sqrt2);
    }
  }
  double operator()(double z) const {
    const double place = (std::clamp(z, -kEnd, kEnd) + kEnd) * kPerUnit;
    const auto i = static_cast<std::size_t>(place);
    return values_[i] + (values_[i + 1] - values_[i]) * (place - static_cast<double>(i));
  }

 private:
  static constexpr double kEnd = 6;
  static constexpr double kPerUnit = 256;
  static constexpr int kSteps = static_cast<int>(2 * kEnd * kPerUnit);
  std::array<double, kSteps + 2> values_;
};

/// Shares of a dot's light in the columns, or rows, from `first` to before `end`.
struct Shares {
  int first = 0, end = 0;
  std::vector<float> of;
};

/// `parts` of each, all of them the same.
Shares shares_along(double middle, double sigma, int parts = 1) {
  static const CumulativeNormal below;
  const double reach = kDotReach * sigma;
  Shares shares;
  shares.first = static_cast<int>(std::floor(middle - reach)) * parts;
  shares.end = (static_cast<int>(std::floor(middle + reach)) + 1) * parts;
  const auto until = [&](int part) { return below((static_cast<double>(part) / parts - middle) / sigma); };
  const double start = until(shares.first), all = until(shares.end) - start;
  double before = start;
  for (int part = shares.first; part < shares.end; ++part) {
    const double here = until(part + 1);
    shares.of.push_back(static_cast<float>((here - before) / all));
    before = here;
  }
  return shares;
}

/// Adds to a row of pixels.
void add_row(const Shares& across, float in_row, const Rgba& colour, int row, Picture& picture) {
  const int left = std::max(0, across.first), right = std::min(picture.width, across.end);
  for (int column = left; column < right; ++column) {
    const float share = in_row * across.of[static_cast<std::size_t>(column - across.first)];
    Rgba& pixel = picture.at(column, row);
    for (std::size_t c = 0; c < 4; ++c) pixel[c] += share * colour[c];
  }
}

/// Adds a dot to the rows from `top` to before `bottom`.
void draw(const StarDot& dot, int top, int bottom, Picture& picture) {
  const auto light = [&](std::size_t c) { return static_cast<float>(dot.light[c]); };
  const Rgba colour{light(0), light(1), light(2), 0.0F};
  const double x = dot.film.x - picture.x, y = dot.film.y - picture.y;
  const double slant = dot.xy / dot.yy, sigma = std::sqrt(dot.xx - slant * dot.xy);
  constexpr double kUpright = 1e-4;
  const int lines = std::abs(dot.xy) < kUpright * dot.yy ? 1 : kLines;
  const Shares down = shares_along(y, std::sqrt(dot.yy), lines);
  const Shares across = shares_along(x, std::sqrt(dot.xx));
  for (int line = std::max(top * lines, down.first); line < std::min(bottom * lines, down.end); ++line) {
    const float in_line = down.of[static_cast<std::size_t>(line - down.first)];
    const double away = (line + 0.5) / lines - y;
    add_row(lines == 1 ? across : shares_along(x + slant * away, sigma), in_line, colour, line / lines,
            picture);
  }
}

/// What is drawn of some images.
struct Dots {
  std::vector<StarDot> dots;
  std::vector<const StarImage*> polar;
};

/// At the pole itself the film shows a point at two places of its edge: one is enough.
bool is_again(const StarImage& image, const std::vector<const StarImage*>& polar, const Camera& camera) {
  const double y = image.film.y;
  return (y == 0 || y == camera.height) && !polar.empty() && polar.back()->star == image.star &&
         polar.back()->film.y == y;
}

/// An image near a pole stands for all of its like that go round the film.
Dots dots_of(std::span<const StarImage> images, const Camera& camera, const SkySpread& sky) {
  Dots dots;
  for (const StarImage& image : images) {
    const FilmPosition film = image.film;
    if (!is_polar(camera, film)) {
      dots.dots.push_back(dot_of(image, camera, sky));
    } else if (film.x >= 0 && film.x < camera.width && film.y >= 0 && film.y <= camera.height &&
               !is_again(image, dots.polar, camera)) {
      dots.polar.push_back(&image);
    }
  }
  return dots;
}

/// For every band the numbers of the dots that reach into it, in their order.
std::vector<std::vector<std::size_t>> dots_by_band(const std::vector<StarDot>& dots, const Picture& picture) {
  std::vector<std::vector<std::size_t>> bands(static_cast<std::size_t>((picture.height + kBand - 1) / kBand));
  for (std::size_t n = 0; n < dots.size(); ++n) {
    const double x = dots[n].film.x - picture.x, y = dots[n].film.y - picture.y;
    const double across = kDotReach * std::sqrt(dots[n].xx) + 1, down = kDotReach * std::sqrt(dots[n].yy) + 1;
    const bool near = x > -across && x < picture.width + across && y > -down && y < picture.height + down;
    if (!near) continue;
    const auto first = static_cast<std::size_t>(std::max(0.0, (y - down) / kBand));
    for (std::size_t band = first; band < bands.size() && static_cast<double>(band) * kBand < y + down;
         ++band) {
      bands[band].push_back(n);
    }
  }
  return bands;
}

}  // namespace

void draw_stars(std::span<const StarImage> images, const PointSpread& spread, const Camera& camera,
                Picture& picture) {
  const SkySpread sky = sky_spread(camera, spread);
  const Dots dots = dots_of(images, camera, sky);
  const auto bands = dots_by_band(dots.dots, picture);
  tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t band) {
    const int top = static_cast<int>(band) * kBand, bottom = std::min(top + kBand, picture.height);
    for (const std::size_t n : bands[band]) draw(dots.dots[n], top, bottom, picture);
    for (const StarImage* image : dots.polar) draw_polar_dot(*image, camera, sky, top, bottom, picture);
  });
}

}  // namespace lensplane
