// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/keyed.h"

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

/// Slope at an inner key from the secants on both sides: their weighted harmonic mean, or flat at an
/// extremum.
double inner_slope(double width_before, double secant_before, double width_after, double secant_after) {
  if (secant_before * secant_after <= 0.0) return 0.0;
  const double weight_before = 2.0 * width_after + width_before;
  const double weight_after = width_after + 2.0 * width_before;
  return (weight_before + weight_after) / (weight_before / secant_before + weight_after / secant_after);
}

/// Slope at an end from its secant and the next one: three-point formula, held back where it would overshoot.
double end_slope(double width, double secant, double next_width, double next_secant) {
  const double slope = ((2.0 * width + next_width) * secant - width * next_secant) / (width + next_width);
  if (slope * secant <= 0.0) return 0.0;
  if (secant * next_secant <= 0.0 && std::abs(slope) > 3.0 * std::abs(secant)) return 3.0 * secant;
  return slope;
}

/// The value at a frame of the component of T that `y(k)` gives for key k.
double interpolate(const std::vector<double>& x, Interpolation interpolation, double frame, auto y) {
  const auto width = [&](std::size_t k) { return x[k + 1] - x[k]; };
  const auto secant = [&](std::size_t k) { return (y(k + 1) - y(k)) / width(k); };
  const std::size_t last = x.size() - 1;
  const auto slope = [&](std::size_t k) {
    if (last == 1) return secant(0);
    if (k == 0) return end_slope(width(0), secant(0), width(1), secant(1));
    if (k == last) return end_slope(width(last - 1), secant(last - 1), width(last - 2), secant(last - 2));
    return inner_slope(width(k - 1), secant(k - 1), width(k), secant(k));
  };
  if (frame <= x.front()) return y(0);
  if (frame >= x.back()) return y(last);
  const auto k = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), frame) - x.begin()) - 1;
  if (frame == x[k] || interpolation == Interpolation::Step) return y(k);
  const double u = (frame - x[k]) / width(k);
  if (interpolation == Interpolation::Linear) return y(k) + (y(k + 1) - y(k)) * u;
  const double rise = u * u * (3.0 - 2.0 * u);
  return y(k) + (y(k + 1) - y(k)) * rise +
         width(k) * u * (1.0 - u) * ((1.0 - u) * slope(k) - u * slope(k + 1));
}

}  // namespace

double value_at(const Keyed<double>& keyed, double frame) {
  return interpolate(keyed.frames, keyed.interpolation, frame,
                     [&](std::size_t k) { return keyed.values[k]; });
}

Vec3 value_at(const Keyed<Vec3>& keyed, double frame) {
  const auto component = [&](int axis) {
    return interpolate(keyed.frames, keyed.interpolation, frame,
                       [&](std::size_t k) { return keyed.values[k][axis]; });
  };
  return {component(0), component(1), component(2)};
}

}  // namespace lensplane
