// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/peer_area_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tests/quality/peer_plate.h"

namespace lensplane {
namespace {

struct Point {
  double x, y;
};

double length(const Point& p) {
  return std::hypot(p.x, p.y);
}

/// Of the steps to either side the smaller, for each coordinate.
double smaller_step(float before, float here, float after) {
  const double low = here - before, high = after - here;
  return std::abs(low) < std::abs(high) ? low : high;
}

/// How far the point that is seen moves from a pixel to the next, in texels, along x or along y of the film.
Point derivative(const LensMap& map, const Picture& plate, int column, int row, int dx, int dy) {
  const auto at = [&](int sign) {
    const int x = std::clamp(column + sign * dx, 0, map.width - 1),
              y = std::clamp(row + sign * dy, 0, map.height - 1);
    return static_cast<std::size_t>(y * map.width + x);
  };
  const std::size_t before = at(-1), here = at(0), after = at(1);
  return {smaller_step(map.s[before], map.s[here], map.s[after]) * plate.width,
          -smaller_step(map.t[before], map.t[here], map.t[after]) * plate.height};
}

/// Makes the parallelogram at least a texel wide, along its sides and across them.
void widen(Point& a, Point& b) {
  const auto at_least_one = [](Point& side) {
    if (const double l = length(side); l > 0 && l < 1) side = {side.x / l, side.y / l};
  };
  if (length(a) == 0) a = length(b) > 0 ? Point{b.y, -b.x} : Point{1, 0};
  if (length(b) == 0) b = {-a.y, a.x};
  at_least_one(a);
  at_least_one(b);
  const Point across_a{a.y / length(a), -a.x / length(a)}, across_b{b.y / length(b), -b.x / length(b)};
  const double of_a = a.x * across_b.x + a.y * across_b.y, of_b = b.x * across_a.x + b.y * across_a.y;
  const auto push = [](Point& side, const Point& across, double width, double sign) {
    side.x += across.x * (1 - std::abs(width)) * sign;
    side.y += across.y * (1 - std::abs(width)) * sign;
  };
  if (std::abs(of_a) < 1) push(a, across_b, of_a, of_a > 0 ? 1 : -1);
  if (std::abs(of_b) < 1) push(b, across_a, of_b, of_b >= 0 ? 1 : -1);
}

/// A bell that is 1 in the middle and 0 one unit away.
double bell(double x) {
  const double a = std::abs(x);
  return a < 1 ? a * a * (2 * a - 3) + 1 : 0;
}

Rgba filtered(const Picture& plate, Wrap edge, const Point& p, Point a, Point b) {
  widen(a, b);
  const double determinant = a.x * b.y - a.y * b.x;
  const double reach_x = std::abs(a.x) + std::abs(b.x), reach_y = std::abs(a.y) + std::abs(b.y);
  std::array<double, 4> sum{};
  double weight = 0;
  for (int row = static_cast<int>(std::ceil(p.y - reach_y - 0.5)); row + 0.5 <= p.y + reach_y; ++row) {
    for (int column = static_cast<int>(std::ceil(p.x - reach_x - 0.5)); column + 0.5 <= p.x + reach_x;
         ++column) {
      const double x = column + 0.5 - p.x, y = row + 0.5 - p.y;
      const double by = bell((x * b.y - y * b.x) / determinant) * bell((y * a.x - x * a.y) / determinant);
      if (by == 0) continue;
      const Rgba texel = texel_at(plate, edge, column, row);
      for (std::size_t c = 0; c < 4; ++c) sum[c] += by * static_cast<double>(texel[c]);
      weight += by;
    }
  }
  Rgba mean{};
  for (std::size_t c = 0; c < 4 && weight > 0; ++c) mean[c] = static_cast<float>(sum[c] / weight);
  return mean;
}

}  // namespace

Picture warped_by_area(const LensMap& map, const Picture& plate, Wrap edge) {
  return warped(map, [&](int column, int row, std::size_t i) {
    const Point p{static_cast<double>(map.s[i]) * plate.width,
                  (1 - static_cast<double>(map.t[i])) * plate.height};
    return filtered(plate, edge, p, derivative(map, plate, column, row, 1, 0),
                    derivative(map, plate, column, row, 0, 1));
  });
}

}  // namespace lensplane
