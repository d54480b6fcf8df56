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

/// Slope at key k from `secant(j)`, the slope of the straight line from key j to j + 1.
double slope_at(const std::vector<double>& x, std::size_t k, auto secant) {
  const auto width = [&](std::size_t j) { return x[j + 1] - x[j]; };
  const std::size_t last = x.size() - 1;
  if (last == 1) return secant(0);
  if (k == 0) return end_slope(width(0), secant(0), width(1), secant(1));
  if (k == last) return end_slope(width(last - 1), secant(last - 1), width(last - 2), secant(last - 2));
  return inner_slope(width(k - 1), secant(k - 1), width(k), secant(k));
}

/// A place between two keys: the share `u` of the frames from key `k` to the next, or on key k.
struct Place {
  std::size_t k;
  double u;
};

Place place_of(const std::vector<double>& x, Interpolation interpolation, double frame) {
  if (frame <= x.front()) return {0, 0.0};
  if (frame >= x.back()) return {x.size() - 1, 0.0};
  const auto k = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), frame) - x.begin()) - 1;
  return {k, interpolation == Interpolation::Step ? 0.0 : (frame - x[k]) / (x[k + 1] - x[k])};
}

/// How far a cubic with these slopes at its ends has risen at u of `width`, when it rises by `rise` in all.
double cubic(double u, double rise, double width, double slope, double next_slope) {
  return rise * (u * u * (3.0 - 2.0 * u)) + width * u * (1.0 - u) * ((1.0 - u) * slope - u * next_slope);
}

/// The value at a frame of the component of T that `y(k)` gives for key k.
double interpolate(const std::vector<double>& x, Interpolation interpolation, double frame, auto y) {
  const auto [k, u] = place_of(x, interpolation, frame);
  if (u == 0.0) return y(k);
  const double rise = y(k + 1) - y(k);
  if (interpolation == Interpolation::Linear) return y(k) + rise * u;
  const auto secant = [&](std::size_t j) { return (y(j + 1) - y(j)) / (x[j + 1] - x[j]); };
  return y(k) + cubic(u, rise, x[k + 1] - x[k], slope_at(x, k, secant), slope_at(x, k + 1, secant));
}

/// Where to a unit vector sets off when it turns: a unit vector square to it, or zero where both are the
/// same.
Vec3 departure(const Vec3& from, const Vec3& to) {
  constexpr double kOpposite = 1e-9;  // nearer than this to opposite, rounding says which way is shorter
  if ((from + to).length() > kOpposite) return (to - from * from.dot(to)).normalized();
  const Vec3 towards = std::abs(from.x) < 1.0 - kOpposite ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return (towards - from * from.dot(towards)).normalized().cross(from);
}

/// The arc from one key to the next.
struct Arc {
  Vec3 from, departure;
  double angle;

  Arc(const Vec3& a, const Vec3& b)
      : from(a), departure(lensplane::departure(a, b)), angle(angle_between(a, b)) {}
  Vec3 at(double turned) const {
    return (from * std::cos(turned) + departure * std::sin(turned)).normalized();
  }
  Vec3 arrival() const { return departure * std::cos(angle) - from * std::sin(angle); }
};

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

Vec3 value_at(const Keyed<Direction>& keyed, double frame) {
  const std::vector<double>& x = keyed.frames;
  const auto [k, u] = place_of(x, keyed.interpolation, frame);
  if (u == 0.0) return keyed.values[k].unit;
  const auto arc = [&](std::size_t j) { return Arc(keyed.values[j].unit, keyed.values[j + 1].unit); };
  const Arc here = arc(k);
  if (keyed.interpolation == Interpolation::Linear) return here.at(here.angle * u);
  // How far the way goes on as it came at the key between arcs j - 1 and j: 1 straight on, 0 from a right
  // angle to turning back.
  const auto straightness = [&](std::size_t j) {
    return std::max(0.0, arc(j - 1).arrival().dot(arc(j).departure));
  };
  const std::size_t last = x.size() - 1;
  const auto slope = [&](std::size_t key) {
    const bool inner = key > 0 && key < last;
    const std::size_t second =
        key == 0 ? 1 : last - 2;  // arc from an end, beyond the first or last key but one
    const auto secant = [&](std::size_t j) {
      const double even = arc(j).angle / (x[j + 1] - x[j]);
      return inner || last == 1 || j != second ? even : even * straightness(key == 0 ? 1 : last - 1);
    };
    return slope_at(x, key, secant) * (inner ? straightness(key) : 1.0);
  };
  return here.at(cubic(u, here.angle, x[k + 1] - x[k], slope(k), slope(k + 1)));
}

}  // namespace lensplane
