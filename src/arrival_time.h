// SPDX-License-Identifier: Apache-2.0
//
// When light arrives: the length of its path and the Shapiro delay, as metres of light travel, compared with
// light in empty space.
//
// What is seen at a finite distance: the path's length, less the straight distance, plus for each mass that
// the light has passed (where finite distances count, for every mass)
//
//   2 m ln((z1 + r1)(z2 + r2)/b^2),    r = hypot(z, b),
//
// z1 the way from the camera to the closest approach and z2 from there to the end. Exact to first order in m
// (I. Shapiro 1964). What is seen at infinity: the path's length up to a wave front there, less that of a
// wave front through the camera; z2 + r2, which has no limit, is counted up to the camera's distance D from
// the mass behind it, z2 + r2 = 2 D: what lies beyond is common to all images.

#pragma once

#include <cmath>

#include "src/ray_path.h"

namespace lensplane {

/// ln((z1 + r1)(z2 + r2)/b^2) without cancellation where z1 or z2 is negative. `far` is z2 + r2.
inline double shapiro_logarithm(double z1, double far, double b) {
  const double r1 = std::hypot(z1, b);
  return z1 >= 0.0 ? std::log((z1 + r1) / b) + std::log(far / b) : std::log(far / (r1 - z1));
}

/// Shapiro delay of the masses that the path has passed, in metres, for light from infinity.
template <class Number>
double shapiro_delay_from_infinity(const RayPath<Number>& path) {
  double delay = 0.0;
  for (const Passage<Number>& p : path.passages) {
    delay += 2.0 * p.m * shapiro_logarithm(value_of(p.path), 2.0 * p.distance, value_of(p.b));
  }
  return delay;
}

/// ln((z1 + r1)(z2 + r2)/b^2) for z1 + z2 > 0.
inline double shapiro_logarithm_between(double z1, double z2, double b) {
  const double r1 = std::hypot(z1, b), r2 = std::hypot(z2, b);
  if (z1 < 0.0) return std::log((z2 + r2) / (r1 - z1));
  if (z2 < 0.0) return std::log((z1 + r1) / (r2 - z2));
  return std::log((z1 + r1) / b) + std::log((z2 + r2) / b);
}

/// The same for light from a point `travelled` metres along the path, of the masses passed until there.
template <class Number>
double shapiro_delay(const RayPath<Number>& path, double travelled) {
  double delay = 0.0;
  for (const Passage<Number>& p : path.passages) {
    const double z1 = value_of(p.path);
    if (z1 > travelled) continue;
    delay += 2.0 * p.m * shapiro_logarithm_between(z1, travelled - z1, value_of(p.b));
  }
  return delay;
}

}  // namespace lensplane
