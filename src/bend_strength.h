// SPDX-License-Identifier: Apache-2.0
//
// What one mass does to a ray, for kernels: how strongly it bends by each law, where the fast forms hold, and
// which rays are captured. Everything is inlined into the loops of planes_batch.cpp.

#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/inlining.h"
#include "src/near_turn.h"
#include "src/planes_batch.h"
#include "src/rotation.h"

namespace lensplane::bend {

template <class Number>
LENSPLANE_ALWAYS_INLINE inline Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Number>
LENSPLANE_ALWAYS_INLINE inline Vector<Number> scaled(const Vector<Number>& a, const Number& s) {
  return {a.x * s, a.y * s, a.z * s};
}

template <class Number>
LENSPLANE_ALWAYS_INLINE inline Vector<Number> sum(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Number>
LENSPLANE_ALWAYS_INLINE inline Vector<Number> difference(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// How strongly a mass bends.
template <class Number>
struct Strength {
  Number per_b;          // alpha/b
  Number arc;            // alpha b
  double steepness = 0;  // -d alpha/db
};

/// What a law needs of b^2: the slow operations, root and division, which a loop of their own has done by the
/// time that the law needs them.
template <Law law, Reach reach, class Number>
LENSPLANE_ALWAYS_INLINE inline Number measured(const Number& b2) {
  if constexpr (law == Law::Weak)
    return reciprocal(b2);
  else if constexpr (law == Law::Exact && reach == Reach::Near)
    return sqrt(b2);
  else
    return reciprocal(sqrt(b2));
}

/// Strength by the law at its full length.
template <Law law, Reach reach, class Number>
LENSPLANE_ALWAYS_INLINE inline Strength<Number> full_strength(double m, const Number& measure) {
  if constexpr (law == Law::Weak) {  // 1/b^2
    const Number per_b = (4.0 * m) * measure;
    return {per_b, Number(4.0 * m), value_of(per_b)};
  } else if constexpr (law == Law::SecondOrder) {  // 1/b
    constexpr double kSecond = 15.0 * std::numbers::pi / 4.0;
    const Number second = (kSecond * m * m) * measure;
    const Number arc = 4.0 * m + second;
    const Number per_b2 = measure * measure;
    return {arc * per_b2, arc, value_of((arc + second) * per_b2)};
  } else if constexpr (reach == Reach::Far) {  // 1/b
    const double b_c = kCriticalRatio * m;
    const Number x = b_c * measure;
    const ValueAndSlope f = polynomial(kFar, value_of(x));
    const Number arc = b_c * chained(x, f.value, f.slope);
    const double steepness = (f.value + value_of(x) * f.slope) * value_of(x * measure);
    return {arc * (measure * measure), arc, steepness};
  } else {  // b
    const Deflection exact = near_exact(m, value_of(measure));
    const Number alpha = chained(measure, exact.alpha, exact.dalpha_db);
    return {alpha * reciprocal(measure), alpha * measure, -exact.dalpha_db};
  }
}

/// b^2 from what measured() keeps of it.
template <Law law, Reach reach, class Number>
LENSPLANE_ALWAYS_INLINE inline Number squared(const Number& measure) {
  if constexpr (law == Law::Weak)
    return reciprocal(measure);
  else if constexpr (law == Law::Exact && reach == Reach::Near)
    return measure * measure;
  else
    return reciprocal(measure * measure);
}

/// `strength` with what the mass's company adds to it.
template <class Number>
LENSPLANE_ALWAYS_INLINE inline Strength<Number> with_company(const Company& company, const Number& b2,
                                                             const Strength<Number>& strength) {
  const Number gain = gain_in(company, b2);
  const Number more = 1.0 + gain;
  const double falls = value_of(gain) * (kCompanyReach / (company.spread2 + kCompanyReach * value_of(b2)));
  return {strength.per_b * more, strength.arc * more,
          strength.steepness * value_of(more) + value_of(strength.arc) * falls};
}

/// The strength that is left at the finite distance of the camera; bend_by() of planes_march.h without
/// branches. `along` is the distance from the camera to the closest approach.
template <Law law, Reach reach, class Number>
LENSPLANE_ALWAYS_INLINE inline Strength<Number> finite_strength(const Deflector& deflector, const Number& b2,
                                                                const Number& along) {
  const bool ahead = value_of(along) >= 0.0;
  const double n = deflector.index;
  const Number r2 = along * along + b2;
  const Number cosine = along * reciprocal(sqrt(r2));
  const Number per_b2 =
      select(ahead, 1.0 + cosine, Number(1.0)) * reciprocal(select(ahead, b2, r2 * (1.0 - cosine)));
  const double weak = 2.0 * deflector.m / n;
  Number per_b = weak * per_b2;
  if constexpr (law != Law::Weak) {
    const Number nearest2 = (n * n) * select(ahead, b2, r2);
    const Number weakest = (4.0 * deflector.m) * reciprocal(nearest2);
    const Number excess_per_b =
        full_strength<law, reach>(deflector.m, measured<law, reach>(nearest2)).per_b - weakest;
    // alpha/b = excess h/b; ahead excess = excess_per_b n b, behind excess_per_b n r.
    const Number reach_over_b = select(ahead, Number(1.0), sqrt(r2) * per_b2 * sqrt(b2));
    const Number share = select(ahead, 1.0 + cosine, b2 * per_b2);
    const Number other = select(ahead, 1.0 + cosine, Number(1.0));
    per_b += (0.25 * n) * excess_per_b * (2.0 - cosine) * share * other * reach_over_b;
  }
  return {per_b, per_b * b2};
}

inline constexpr double kLeastB2 = 1e-280;  // smaller squares lose digits
inline constexpr double kFarthest = 1e139;  // products of squares of larger lengths overflow

/// Smallest impact parameter, over m, of the kernels for light far from the masses.
inline constexpr double kFarImpact = kCriticalRatio / kFarRatio;

template <Reach reach, class Number>
LENSPLANE_ALWAYS_INLINE inline Turn<Number> turn_within(const Number& q) {
  if constexpr (reach == Reach::Far)
    return short_turn(q);
  else
    return near_turn(q);
}

template <Reach reach>
LENSPLANE_ALWAYS_INLINE inline bool turn_fits(double q) {
  return reach == Reach::Far ? q <= kShortTurn * kShortTurn : q <= kLongestTurn * kLongestTurn;
}

/// What a kernel has to know of a mass beside its law.
template <Reach reach>
struct Limits {
  Limits(const Deflector& deflector, bool finite) : m(deflector.m), n(deflector.index) {
    const double distance = length(deflector.position);
    // A bend that grows by its company is as far away as one of as much more mass.
    const double more = 1.0 + gain_in(deflector.company, 0.0);
    const double b = reach == Reach::Far ? kFarImpact * m * more : 0.0;
    least_b2 = std::max(b / n * (b / n), kLeastB2);
    least_b2_behind = kLeastB2;
    const bool near_camera =
        finite && distance < (reach == Reach::Far ? kFarImpact * more : kPhotonSphere) * m;
    if (near_camera || !(distance < kFarthest)) {
      least_b2 = least_b2_behind = std::numeric_limits<double>::infinity();  // no ray fits
      capture_ratio = 0.0;
    }
  }

  double m, n;
  double least_b2, least_b2_behind;
  double capture_ratio = 1.0;

  /// Does the kernel do for this impact parameter? (False for a NaN.)
  LENSPLANE_ALWAYS_INLINE bool fit(bool ahead, double b2) const {
    return b2 >= (ahead ? least_b2 : least_b2_behind);
  }
  /// Is the light captured: no farther than b_c from a mass ahead?
  LENSPLANE_ALWAYS_INLINE bool capture(bool ahead, double b2) const {
    const CriticalRadius critical = critical_radius(m * capture_ratio);
    return ahead & ((n * std::sqrt(b2) - critical.b_c) - critical.rest <= 0.0) & (capture_ratio != 0.0);
  }
};

/// Marks a ray that the kernel does not do for, or that is captured. `onward`: it has not turned back.
template <Reach reach, class Number>
LENSPLANE_ALWAYS_INLINE inline void mark(int i, const Limits<reach>& limits, bool onward, bool ahead,
                                         double b2, LineBatch<Number>& rays) {
  const bool fits = limits.fit(ahead, b2) & onward;
  if constexpr (reach == Reach::Near) {
    const bool captured = (rays.captured[i] != 0.0) | (onward & limits.capture(ahead, b2));
    rays.captured[i] = captured ? 1.0 : 0.0;
    rays.irregular[i] = fits | captured ? rays.irregular[i] : 1.0;
  } else {
    rays.irregular[i] = fits ? rays.irregular[i] : 1.0;
  }
}

}  // namespace lensplane::bend
