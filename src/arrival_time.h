// SPDX-License-Identifier: Apache-2.0
//
// When light arrives: the length of its path and the Shapiro delay, as metres of light travel, compared with
// light in empty space.
//
// What is seen at a finite distance: the path's length, less the straight distance, plus for each mass that
// the light has passed (where finite distances count, for every mass)
//
//   2 m ln((z1 + r1)(z2 + r2)/b^2) + w(b),    r = hypot(z, b),
//
// z1 the way from the camera to the closest approach and z2 from there to the end. The logarithm is exact to
// first order in m (I. Shapiro 1964). What is seen at infinity: the path's length up to a wave front there,
// less that of a wave front through the camera; z2 + r2, which has no limit, is counted up to the camera's
// distance D from the mass behind it, z2 + r2 = 2 D: what lies beyond is common to all images.
//
// By Fermat's principle the law of deflection determines the higher orders: with the path's length measured
// round the mass by an arc of alpha b, the rest is the integral of alpha from b to infinity, so that
//
//   w(b) = int (alpha - 4 m/b) db = (15 pi/4) m^2/b + ...
//
// for the law that bends the ray, 0 for the weak one. Where the camera is near, of w as of alpha only the
// share h(cos R) counts that lies ahead of it (planes_march.h). The path's length comes as the sum of small
// terms (path_excess.h).

#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/exact_law.h"
#include "src/ray_path.h"

namespace lensplane {

/// w(b), metres.
inline double delay_of_higher_orders(Law law, double m, double b) {
  constexpr double kSecond = 15.0 * std::numbers::pi / 4.0;
  if (law == Law::Weak || !(b > 0.0)) return 0.0;
  return law == Law::SecondOrder ? kSecond * m * m / b : exact_excess_beyond(m, b);
}

/// h(c): the share of the higher orders that lies ahead of an end at which the mass lies in the direction c.
constexpr double share_ahead(double c) {
  return 0.25 * (1.0 + c) * (1.0 + c) * (2.0 - c);
}

/// w(b) of a mass that the light passes after z1; `to_end` is the cosine at the other end, 1 at infinity.
template <class Number>
double delay_of_higher_orders(const Passage<Number>& p, double to_end) {
  const double b = value_of(p.b), z1 = value_of(p.path), r1 = std::hypot(z1, b);
  if (!p.finite) return delay_of_higher_orders(p.law, p.m, b);
  const double share = share_ahead(z1 / r1) + share_ahead(to_end) - 1.0;
  return std::max(share, 0.0) * delay_of_higher_orders(p.law, p.m, p.index * (z1 >= 0.0 ? b : r1));
}

/// ln((z1 + r1)(z2 + r2)/b^2) without cancellation where z1 or z2 is negative. `far` is z2 + r2.
inline double shapiro_logarithm(double z1, double far, double b) {
  const double r1 = std::hypot(z1, b);
  return z1 >= 0.0 ? std::log((z1 + r1) / b) + std::log(far / b) : std::log(far / (r1 - z1));
}

/// Delay by the masses that the path has passed, beside its length, in metres, for light from infinity.
template <class Number>
double shapiro_delay_from_infinity(const RayPath<Number>& path) {
  double delay = 0.0;
  for (const Passage<Number>& p : path.passages) {
    delay += 2.0 * p.m * shapiro_logarithm(value_of(p.path), 2.0 * p.distance, value_of(p.b)) +
             delay_of_higher_orders(p, 1.0);
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
    const double z1 = value_of(p.path), b = value_of(p.b);
    if (z1 > travelled) continue;
    const double z2 = travelled - z1;
    delay +=
        2.0 * p.m * shapiro_logarithm_between(z1, z2, b) + delay_of_higher_orders(p, z2 / std::hypot(z2, b));
  }
  return delay;
}

}  // namespace lensplane
