// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/pixel_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/composite/polar_footprints.h"

namespace lensplane {
namespace {

constexpr float kLeastVeil = 0.02F;    // of alpha: less of a hole, or of a veil, hides nothing
constexpr float kLeastChange = 0.05F;  // of alpha within a pixel

/// Weights of places side by side, `spacing` apart, that have this variance: of a Gaussian whose width is
/// found by trial, because so few places cut its tails off.
std::vector<double> weights_with(double variance, int places, double spacing) {
  std::vector<double> weights(static_cast<std::size_t>(places));
  double width = variance;
  for (int round = 0; round < 60; ++round) {
    double sum = 0, second = 0;
    for (int i = 0; i < places; ++i) {
      const double x = (i - places / 2) * spacing;
      const double weight = weights[static_cast<std::size_t>(i)] = std::exp(-0.5 * x * x / width);
      sum += weight;
      second += weight * x * x;
    }
    for (double& weight : weights) weight /= sum;
    width *= variance / (second / sum);
  }
  return weights;
}

/// `places` x `places` parts; `spacing` in standard deviations of the pixel filter, at most 1.5 times
/// `scale`, or their pattern would show.
std::vector<PixelPart> make_parts(int places, double spacing, double scale) {
  const std::vector<double> weights = weights_with(1 - scale * scale, places, spacing);
  std::vector<PixelPart> parts;
  for (int j = 0; j < places; ++j) {
    for (int i = 0; i < places; ++i) {
      const auto place = [&](int n) { return (n - places / 2) * spacing * kPixelSigma; };
      parts.push_back({place(i), place(j),
                       weights[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(j)], scale});
    }
  }
  return parts;
}

/// A pixel in its parts.
class PartedPixel {
 public:
  PartedPixel(std::span<const SeenPoint> centre, std::span<const Bend> bends)
      : centre_(centre), bends_(bends), points_(centre.begin(), centre.end()) {}

  std::span<const SeenPoint> from(const PixelPart& part) {
    for (std::size_t k = 0; k < points_.size(); ++k) {
      if (centre_[k].hit) points_[k] = seen_from(centre_[k], bends_[k], part);
    }
    return points_;
  }

  Rgba seen_by(Viewer& viewer, std::span<const PixelPart> parts) {
    std::array<double, 4> sum{};
    for (const PixelPart& part : parts) {
      const Rgba colour = viewer.see(from(part), part.scale, {part.x, part.y});
      for (std::size_t c = 0; c < 4; ++c) sum[c] += part.weight * static_cast<double>(colour[c]);
    }
    Rgba mean{};
    for (std::size_t c = 0; c < 4; ++c) mean[c] = static_cast<float>(sum[c]);
    return mean;
  }

  /// Whether the nearest surface is clear to different degrees within the pixel.
  bool is_veil_uneven(Viewer& viewer) {
    constexpr double kAside = 0.4, kScale = 0.6;
    constexpr std::array<PixelPart, 4> kAround = {{{kAside, kAside, 0, kScale},
                                                   {-kAside, kAside, 0, kScale},
                                                   {kAside, -kAside, 0, kScale},
                                                   {-kAside, -kAside, 0, kScale}}};
    float least = 1, most = 0;
    for (const PixelPart& part : kAround) {
      const float alpha = viewer.nearest_alpha(from(part), part.scale);
      least = std::min(least, alpha);
      most = std::max(most, alpha);
    }
    return most - least > kLeastChange;
  }

 private:
  std::span<const SeenPoint> centre_;
  std::span<const Bend> bends_;
  std::vector<SeenPoint> points_;  // of one part
};

/// Around the poles of globes (s, t) always bend: polar_footprints.h sees to that.
bool is_polar(const Surface& surface, const SeenPoint& point) {
  const bool globe = std::holds_alternative<LatLong>(surface) || std::holds_alternative<Sphere>(surface);
  return globe && bends_around_pole(point.st, point.footprint);
}

/// Of all surfaces, at a pixel whose neighbours meet the same.
std::vector<Bend> bends_of(const CentreGrid& grid, const std::vector<Surface>& surfaces, int column,
                           int row) {
  const auto at = [&](int x, int y) { return grid.points(grid.place(column + x, row + y)); };
  const auto centre = at(0, 0), left = at(-1, 0), right = at(1, 0), above = at(0, -1), below = at(0, 1);
  std::vector<Bend> bends(surfaces.size());
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (!centre[k].hit || is_polar(surfaces[k], centre[k])) continue;
    bends[k] = bend_between(left[k].footprint, right[k].footprint, above[k].footprint, below[k].footprint);
  }
  return bends;
}

}  // namespace

Bend bend_between(const Footprint& left, const Footprint& right, const Footprint& above,
                  const Footprint& below) {
  const auto half = [](double from, double to) { return 0.5 * (to - from); };
  return {half(left.ds_dx, right.ds_dx),
          0.5 * (half(left.ds_dy, right.ds_dy) + half(above.ds_dx, below.ds_dx)),
          half(above.ds_dy, below.ds_dy),
          half(left.dt_dx, right.dt_dx),
          0.5 * (half(left.dt_dy, right.dt_dy) + half(above.dt_dx, below.dt_dx)),
          half(above.dt_dy, below.dt_dy)};
}

std::span<const PixelPart> bent_parts() {
  static const auto parts = make_parts(5, 0.85, 0.6);
  return parts;
}

std::span<const PixelPart> veil_parts() {
  static const auto parts = make_parts(11, 0.48, 0.32);
  return parts;
}

SeenPoint seen_from(const SeenPoint& centre, const Bend& bend, const PixelPart& part) {
  SeenPoint point = centre;
  Footprint& f = point.footprint;
  const double x = part.x, y = part.y, spread = part.scale * kPixelSigma, mean = 0.5 * spread * spread;
  point.st.s += f.ds_dx * x + f.ds_dy * y + 0.5 * (bend.s_xx * x * x + bend.s_yy * y * y) +
                bend.s_xy * x * y + mean * (bend.s_xx + bend.s_yy);
  point.st.t += f.dt_dx * x + f.dt_dy * y + 0.5 * (bend.t_xx * x * x + bend.t_yy * y * y) +
                bend.t_xy * x * y + mean * (bend.t_xx + bend.t_yy);
  f.ds_dx += bend.s_xx * x + bend.s_xy * y;
  f.ds_dy += bend.s_xy * x + bend.s_yy * y;
  f.dt_dx += bend.t_xx * x + bend.t_xy * y;
  f.dt_dy += bend.t_xy * x + bend.t_yy * y;
  return point;
}

Rgba see_pixel(const CentreGrid& grid, const std::vector<Surface>& surfaces, int column, int row,
               PixelKind kind, Viewer& viewer) {
  const std::span<const SeenPoint> centre = grid.points(grid.place(column, row));
  Rgba colour{};
  std::vector<Bend> bends;
  if (kind == PixelKind::Bent) {
    bends = bends_of(grid, surfaces, column, row);
    colour = PartedPixel(centre, bends).seen_by(viewer, bent_parts());
  } else {
    colour = viewer.see(centre, 1.0);
  }
  if (!viewer.saw_through(kLeastVeil)) return colour;
  bends.resize(centre.size());
  PartedPixel pixel(centre, bends);
  return pixel.is_veil_uneven(viewer) ? pixel.seen_by(viewer, veil_parts()) : colour;
}

}  // namespace lensplane
