// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/peer_supersampling.h"

#include <algorithm>
#include <cmath>

#include "tests/quality/peer_plate.h"

namespace lensplane {
namespace {

constexpr double kMostPowers = 4;  // of 3

struct Point {
  double x, y;
};

/// From texel to texel by a straight line, or by the curve that has no slope at either.
Rgba interpolated(const Picture& plate, Wrap edge, const Point& p, bool smooth) {
  const double x = p.x - 0.5, y = p.y - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const auto share = [&](double f) { return static_cast<float>(smooth ? f * f * (3 - 2 * f) : f); };
  const float right = share(x - column), down = share(y - row);
  Rgba mean{};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const Rgba texel = texel_at(plate, edge, column + i, row + j);
      const float by = (i ? right : 1 - right) * (j ? down : 1 - down);
      for (std::size_t c = 0; c < 4; ++c) mean[c] += by * texel[c];
    }
  }
  return mean;
}

/// From one neighbour to the other, per pixel, in texels.
Point derivative(const LensMap& map, const Picture& plate, int column, int row, int dx, int dy) {
  const auto at = [&](int sign) {
    const int x = std::clamp(column + sign * dx, 0, map.width - 1),
              y = std::clamp(row + sign * dy, 0, map.height - 1);
    return static_cast<std::size_t>(y * map.width + x);
  };
  return {0.5 * static_cast<double>(map.s[at(1)] - map.s[at(-1)]) * plate.width,
          -0.5 * static_cast<double>(map.t[at(1)] - map.t[at(-1)]) * plate.height};
}

/// How many points lie along a side: a power of 3.
int points_along(const Point& side) {
  const double length = std::hypot(side.x, side.y);
  if (length <= 1) return 1;
  const double powers = std::min(std::log(length) / std::log(3.0), kMostPowers);
  return static_cast<int>(std::lround(std::pow(3.0, std::ceil(powers - 0.5))));
}

Rgba supersampled(const Picture& plate, Wrap edge, const Point& p, const Point& a, const Point& b) {
  const int across = points_along(a), down = points_along(b);
  const Rgba middle = interpolated(plate, edge, p, true);
  std::array<double, 4> sum{};
  for (int j = -(down / 2); j <= down / 2; ++j) {
    for (int i = -(across / 2); i <= across / 2; ++i) {
      const double u = static_cast<double>(i) / across, v = static_cast<double>(j) / down;
      const Rgba seen =
          i == 0 && j == 0
              ? middle
              : interpolated(plate, edge, {p.x + u * a.x + v * b.x, p.y + u * a.y + v * b.y}, false);
      for (std::size_t c = 0; c < 4; ++c) sum[c] += static_cast<double>(seen[c]);
    }
  }
  Rgba mean{};
  for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<float>(sum[c] / (across * down));
  return mean;
}

}  // namespace

Picture warped_by_supersampling(const LensMap& map, const Picture& plate, Wrap edge) {
  return warped(map, [&](int column, int row, std::size_t i) {
    const Point p{static_cast<double>(map.s[i]) * plate.width,
                  (1 - static_cast<double>(map.t[i])) * plate.height};
    return supersampled(plate, edge, p, derivative(map, plate, column, row, 1, 0),
                        derivative(map, plate, column, row, 0, 1));
  });
}

}  // namespace lensplane
