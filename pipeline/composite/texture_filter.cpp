// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/texture_filter.h"

#include <algorithm>
#include <cmath>

#include "pipeline/composite/close_filter.h"
#include "pipeline/composite/elliptical_filter.h"
#include "pipeline/composite/long_filter.h"
#include "pipeline/composite/polar_footprints.h"
#include "pipeline/composite/surface_kernel.h"
#include "pipeline/composite/weighted_sum.h"

namespace lensplane {
namespace {

/// A Gaussian as wide as this many pictures along an axis sees their mean.
double widest(Wrap wrap) {
  return wrap == Wrap::Repeat || wrap == Wrap::Globe ? 1 : 4;
}

Covariance scaled(const Covariance& c, double x, double y) {
  return {c.xx * x * x, c.xy * x * y, c.yy * y * y};
}

/// An ellipse that is no longer than a few pictures.
struct Ellipse {
  Covariance covariance;
  AxisVariances axes;
};
Ellipse limited(const TexelFilter& filter, const PixelWindows& window, Wrap wrap) {
  const Covariance& c = filter.covariance;
  const auto limit = [&](double variance, int size) {
    const double most = widest(wrap) * size;
    return variance > most * most ? most / std::sqrt(variance) : 1.0;
  };
  const double x = limit(c.xx, window.display_width), y = limit(c.yy, window.display_height);
  if (x == 1 && y == 1) return {c, filter.axes};
  const Covariance less = scaled(c, x, y);
  return {less, variances_of(less)};
}

/// What is left for the elliptical filter to do on a level; `total` is to be done on the finest.
Covariance left_on_level(const std::vector<TexelLevel>& levels, std::size_t level, const Covariance& total) {
  const PixelWindows& whole = levels.front().window;
  const TexelLevel& coarse = levels[level];
  Covariance left = scaled(total, static_cast<double>(coarse.window.display_width) / whole.display_width,
                           static_cast<double>(coarse.window.display_height) / whole.display_height);
  left.xx -= coarse.variance_x;
  left.yy -= coarse.variance_y;
  return widened(left, kSmallestVariance);
}

double texels_in(const Covariance& c) {
  return kTexelsPerEllipse * std::sqrt(std::max(0.0, c.xx * c.yy - c.xy * c.xy));
}

/// (x, y) of (s, t) on a level, in texels from the centre of the first.
struct TexelPosition {
  double x, y;
};
TexelPosition position_on(const PixelWindows& window, TextureCoordinates st) {
  constexpr double kFar = 1e8;  // farther out lookups need no more precision than texel numbers have
  return {std::clamp(st.s * window.display_width - 0.5, -kFar, kFar),
          std::clamp((1.0 - st.t) * window.display_height - 0.5, -kFar, kFar)};
}

/// Does an ellipse reach none of the stored texels, whatever filter is taken for it?
bool is_beyond(const PixelWindows& window, const TexelPosition& at, const Covariance& pixel) {
  constexpr double kReach = 8, kMore = 8;
  const double x = kReach * std::sqrt(pixel.xx) + kMore, y = kReach * std::sqrt(pixel.yy) + kMore;
  return at.x < window.x - x || at.x > window.x + window.width + x || at.y < window.y - y ||
         at.y > window.y + window.height + y;
}

Rgba elliptical(Texels& texels, TextureCoordinates st, const Ellipse& ellipse, double most_texels) {
  const auto& levels = texels.levels();
  const Covariance& pixel = ellipse.covariance;
  const double surface = surface_variance(ellipse.axes.minor);
  const Covariance total{pixel.xx + surface, pixel.xy, pixel.yy + surface};
  // The coarsest level on which the shorter axis is still at least a texel long.
  const int longest = std::ilogb(std::max(1.0, ellipse.axes.minor + surface)) / 2;
  auto level = std::min(static_cast<std::size_t>(longest), levels.size() - 1);
  Covariance left = left_on_level(levels, level, total);
  while (texels_in(left) > most_texels && level + 1 < levels.size()) {
    left = left_on_level(levels, ++level, total);
  }
  const TexelPosition at = position_on(levels[level].window, st);
  return elliptical_mean(texels, static_cast<int>(level), at.x, at.y, left);
}

/// Under a footprint that is straight enough to be an ellipse. `part` of a pixel: so much of the most that a
/// lookup may cost.
Rgba seen(Texels& texels, TextureCoordinates st, const Footprint& footprint, double part) {
  const PixelWindows& window = texels.levels().front().window;
  const TexelFilter filter = texel_filter(footprint, window.display_width, window.display_height);
  const Ellipse ellipse = limited(filter, window, texels.wrap());
  const auto& [pixel, axes] = ellipse;
  st.s += filter.dx / window.display_width;
  st.t -= filter.dy / window.display_height;
  const TexelPosition at = position_on(window, st);
  if (texels.wrap() == Wrap::Black && is_beyond(window, at, pixel)) return {0, 0, 0, 0};
  const double share = std::clamp(2.0 * part, 0.1, 1.0), longest = kLongestSigma * share;
  // Parts of a pixel add up to its filter: for them an ellipse does as soon as it is large enough for texels.
  const double widest =
      part < 1 ? kSmallestVariance - surface_variance(kSmallestVariance) : kLargestCloseVariance;
  if (axes.minor > widest || axes.major > longest * longest) {
    return elliptical(texels, st, ellipse, kMostTexels * share * share);
  }
  return close_mean(texels, at.x, at.y, pixel);
}

}  // namespace

Rgba filtered_texels(Texels& texels, TextureCoordinates st, const Footprint& footprint) {
  const bool readable = std::isfinite(st.s) && std::isfinite(st.t) && std::isfinite(footprint.scale);
  if (!readable || !is_finite(footprint)) {
    constexpr double kWhole = 1e6;
    return seen(texels, {0.5, 0.5}, {.ds_dx = kWhole, .dt_dy = kWhole}, 1);
  }
  const bool polar = texels.wrap() == Wrap::Globe && bends_around_pole(st, footprint);
  if (!polar) return seen(texels, st, footprint, footprint.scale);
  if (footprint.scale <= kPolarPartSigma) return seen(texels, st, footprint, 1);  // it is a part already
  WeightedSum sum;
  for_each_polar_part(st, footprint, [&](double weight, const PolarPart& part) {
    sum.add(weight, seen(texels, part.st, part.footprint, 1));
  });
  return sum.mean_or([&] { return seen(texels, st, footprint, 1); });
}

}  // namespace lensplane
