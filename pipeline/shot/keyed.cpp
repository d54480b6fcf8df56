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

/// Slope of the monotone cubic at key `k`.
double slope_at(const std::vector<double>& x, const std::vector<double>& y, std::size_t k) {
  const auto width = [&x](std::size_t i) { return x[i + 1] - x[i]; };
  const auto secant = [&](std::size_t i) { return (y[i + 1] - y[i]) / width(i); };
  const std::size_t last = x.size() - 1;
  if (last == 1) return secant(0);
  if (k == 0) return end_slope(width(0), secant(0), width(1), secant(1));
  if (k == last) return end_slope(width(last - 1), secant(last - 1), width(last - 2), secant(last - 2));
  return inner_slope(width(k - 1), secant(k - 1), width(k), secant(k));
}

double smooth(const std::vector<double>& x, const std::vector<double>& y, std::size_t k, double frame) {
  const double width = x[k + 1] - x[k];
  const double u = (frame - x[k]) / width;
  const double rise = u * u * (3.0 - 2.0 * u);
  return y[k] + (y[k + 1] - y[k]) * rise +
         width * u * (1.0 - u) * ((1.0 - u) * slope_at(x, y, k) - u * slope_at(x, y, k + 1));
}

}  // namespace

double value_at(const Keyed<double>& keyed, double frame) {
  const auto& [frames, values, interpolation] = keyed;
  if (frame <= frames.front()) return values.front();
  if (frame >= frames.back()) return values.back();
  const auto after = std::upper_bound(frames.begin(), frames.end(), frame);
  const auto k = static_cast<std::size_t>(after - frames.begin()) - 1;
  if (frame == frames[k] || interpolation == Interpolation::Step) return values[k];
  if (interpolation == Interpolation::Smooth) return smooth(frames, values, k, frame);
  const double u = (frame - frames[k]) / (frames[k + 1] - frames[k]);
  return values[k] + (values[k + 1] - values[k]) * u;
}

Vec3 value_at(const Keyed<Vec3>& keyed, double frame) {
  const auto component = [&](int axis) {
    Keyed<double> one{keyed.frames, {}, keyed.interpolation};
    one.values.clear();
    for (const Vec3& value : keyed.values) one.values.push_back(value[axis]);
    return value_at(one, frame);
  };
  return {component(0), component(1), component(2)};
}

}  // namespace lensplane
