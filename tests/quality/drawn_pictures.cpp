// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/drawn_pictures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "src/constants.h"

namespace lensplane {
namespace {

/// `colour` of every texel's centre.
Picture drawn(int width, int height, const std::function<Rgba(double x, double y)>& colour) {
  Picture picture{width, height, 0, 0, width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      picture.pixels.push_back(colour(column + 0.5, row + 0.5));
    }
  }
  return picture;
}

/// How much of a texel a line covers whose middle is `away` texels away.
double line_share(double away, double width) {
  return std::clamp(0.5 + 0.5 * width - std::abs(away), 0.0, 1.0);
}

/// From x to the nearest multiple of `period`.
double to_nearest(double x, double period) {
  return x - period * std::round(x / period);
}

}  // namespace

Picture line_art(int width, int height, int frame, bool paper) {
  const double unit = static_cast<double>(width) / frame;  // texels of a pixel
  return drawn(width, height, [=](double column, double row) {
    const double x = column - 0.5 * width, y = row - 0.5 * height, r = std::hypot(x, y);
    double ink = line_share(to_nearest(x + 3 * unit, 32 * unit), 1 * unit);
    ink = std::max(ink, line_share(to_nearest(y - 5 * unit, 24 * unit), 2 * unit));
    ink = std::max(ink, line_share(to_nearest(0.8 * x - 0.6 * y, 40 * unit), 1.5 * unit));
    ink = std::max(ink, line_share(to_nearest(r, 29 * unit), 3 * unit));
    const double ray = to_nearest(std::atan2(y, x), kPi / 12);
    ink = std::max(ink, line_share(r * std::sin(ray), 1 * unit) * std::clamp(r / unit - 12, 0.0, 1.0));
    const auto share = static_cast<float>(ink);
    return paper ? Rgba{1 - share, 1 - share, 1 - 0.9F * share, 1} : Rgba{share, 0.1F * share, 0, share};
  });
}

Picture graticule(int width, int height) {
  return drawn(width, height, [=](double column, double row) {
    const double longitude = 2 * kPi * column / width, latitude = kPi * (0.5 - row / height);
    const double texel = kPi / height;
    const double parallels = line_share(to_nearest(latitude, kPi / 12) / texel, 4);
    const double meridians =
        line_share(std::cos(latitude) * std::sin(to_nearest(longitude, kPi / 12)) / texel, 4);
    const double ink = std::max(parallels, meridians), wave = std::cos(latitude);
    const auto channel = [&](double phase, double lon, double lat) {
      const double light = 0.45 + 0.35 * std::sin(lon * longitude + phase) * wave * std::cos(lat * latitude);
      return static_cast<float>(light + ink * ((phase == 0 ? 1.0 : 0.9) - light));
    };
    return Rgba{channel(0, 3, 5), channel(1, 5, 3), channel(2, 8, 7), 1};
  });
}

Picture bright_stars(int width, int height) {
  Picture sky = drawn(width, height, [=](double column, double row) {
    const double longitude = 2 * kPi * column / width, latitude = kPi * (0.5 - row / height);
    const double band = std::exp(-std::pow(6 * (latitude - 0.5 * std::sin(longitude)), 2));
    return Rgba{static_cast<float>(0.004 + 0.05 * band), static_cast<float>(0.004 + 0.04 * band),
                static_cast<float>(0.006 + 0.035 * band), 1};
  });
  std::mt19937 random(7);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int star = 0; star < 1200; ++star) {
    const double x = share() * width, sine = 2 * share() - 1;
    const double y = (0.5 - std::asin(sine) / kPi) * height;
    const double peak = std::pow(300.0, share()), warm = share();
    const double stretch = 1 / std::max(0.02, std::sqrt(1 - sine * sine)), sigma = 1.5;
    const int reach_x = static_cast<int>(5 * sigma * stretch), reach_y = static_cast<int>(5 * sigma);
    for (int row = static_cast<int>(y) - reach_y; row <= static_cast<int>(y) + reach_y; ++row) {
      if (row < 0 || row >= height) continue;
      for (int column = static_cast<int>(x) - reach_x; column <= static_cast<int>(x) + reach_x; ++column) {
        const double dx = (column + 0.5 - x) / (sigma * stretch), dy = (row + 0.5 - y) / sigma;
        const double light = peak * std::exp(-0.5 * (dx * dx + dy * dy));
        Rgba& texel = sky.at((column % width + width) % width, row);
        texel[0] += static_cast<float>(light * (0.6 + 0.4 * warm));
        texel[1] += static_cast<float>(light * 0.8);
        texel[2] += static_cast<float>(light * (1 - 0.4 * warm));
      }
    }
  }
  return sky;
}

Picture plain_picture(int width, int height, const Rgba& colour) {
  return drawn(width, height, [&](double, double) { return colour; });
}

}  // namespace lensplane
