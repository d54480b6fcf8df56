// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/footprint.h"

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

/// Texels: no texture needs more than this, and squares of it are finite.
constexpr double kLargest = 1e15;

}  // namespace

bool is_finite(const Footprint& footprint) {
  return std::isfinite(footprint.ds_dx) && std::isfinite(footprint.ds_dy) && std::isfinite(footprint.dt_dx) &&
         std::isfinite(footprint.dt_dy) && std::isfinite(footprint.x) && std::isfinite(footprint.y);
}

Covariance covariance_in_texels(const Footprint& footprint, int width, int height) {
  const auto texels = [](double per_pixel, int size) {
    return std::clamp(per_pixel * size * kPixelSigma, -kLargest, kLargest);
  };
  const double xx = texels(footprint.ds_dx, width), xy = texels(footprint.ds_dy, width);
  const double yx = texels(-footprint.dt_dx, height), yy = texels(-footprint.dt_dy, height);
  return {xx * xx + xy * xy, xx * yx + xy * yy, yx * yx + yy * yy};
}

AxisVariances variances_of(const Covariance& covariance) {
  const double mean = (covariance.xx + covariance.yy) / 2;
  const double half = (covariance.xx - covariance.yy) / 2;
  const double major = mean + std::sqrt(half * half + covariance.xy * covariance.xy);
  if (!(major > 0)) return {};
  // The product of the two is the determinant: no cancellation for long ellipses.
  const double determinant = covariance.xx * covariance.yy - covariance.xy * covariance.xy;
  return {major, std::clamp(determinant / major, 0.0, major)};
}

Axes axes_of(const Covariance& covariance) {
  Axes axes{variances_of(covariance), 1, 0};
  const double mean = (covariance.xx + covariance.yy) / 2;
  const double half = (covariance.xx - covariance.yy) / 2;
  const double radius = axes.major - mean;
  if (!(radius > 1e-12 * mean)) return axes;
  // Half the angle of (half, xy), from the larger of two expressions for it.
  const double x = half >= 0 ? half + radius : std::abs(covariance.xy);
  const double y = half >= 0 ? covariance.xy : std::copysign(radius - half, covariance.xy);
  const double length = std::sqrt(x * x + y * y);
  axes.x = x / length;
  axes.y = y / length;
  return axes;
}

double own_variance(double variance) {
  constexpr double kOneToOne = kPixelSigma * kPixelSigma, kTwoToOne = 4 * kOneToOne;
  return kOwnVariance * std::clamp((kTwoToOne - variance) / (kTwoToOne - kOneToOne), 0.0, 1.0);
}

TexelFilter texel_filter(const Footprint& footprint, int width, int height) {
  const Covariance whole = covariance_in_texels(footprint, width, height);
  const auto [major, minor] = variances_of(whole);
  const auto left_of = [](double variance) { return std::max(0.0, variance - own_variance(variance)); };
  // Functions of a matrix: f(minor) and what f grows by to f(major), along the longer axis.
  const double apart = major - minor;
  const Covariance longer =
      apart > 0 ? Covariance{(whole.xx - minor) / apart, whole.xy / apart, (whole.yy - minor) / apart}
                : Covariance{};
  const double least = left_of(minor), more = left_of(major) - least;
  const double scale = std::clamp(footprint.scale, 0.0, 1e3), size = scale * scale;
  TexelFilter filter;
  filter.axes = {size * (least + more), size * least};
  filter.covariance = {size * (least + more * std::max(0.0, longer.xx)), size * more * longer.xy,
                       size * (least + more * std::max(0.0, longer.yy))};
  if (footprint.x == 0 && footprint.y == 0) return filter;
  const auto drawn = [&](double variance) {
    return variance > 0 ? std::sqrt(left_of(variance) / variance) - 1 : -1.0;
  };
  const double across = drawn(minor), along = drawn(major) - across;
  const auto limited = [](double texels) { return std::clamp(texels, -kLargest, kLargest); };
  const double right = limited(width * (footprint.ds_dx * footprint.x + footprint.ds_dy * footprint.y));
  const double down = limited(-height * (footprint.dt_dx * footprint.x + footprint.dt_dy * footprint.y));
  filter.dx = across * right + along * (longer.xx * right + longer.xy * down);
  filter.dy = across * down + along * (longer.xy * right + longer.yy * down);
  return filter;
}

Covariance widened(const Covariance& covariance, double least) {
  const double mean = (covariance.xx + covariance.yy) / 2;
  const double half = (covariance.xx - covariance.yy) / 2;
  const double radius = std::sqrt(half * half + covariance.xy * covariance.xy);
  const double major = mean + radius, minor = mean - radius;
  if (!(major > least)) return {least, 0, least};
  if (minor >= least) return covariance;
  // (major - C) / (major - minor) is 1 along the shorter axis and 0 along the longer one.
  const double lift = (least - minor) / (major - minor);
  return {covariance.xx + lift * (major - covariance.xx), covariance.xy - lift * covariance.xy,
          covariance.yy + lift * (major - covariance.yy)};
}

}  // namespace lensplane
