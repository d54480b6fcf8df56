// SPDX-License-Identifier: Apache-2.0
//
// The sums of planes_march.cpp over the masses of one plane, for kernels: inlined into their loops.

#pragma once

#include "src/bend_strength.h"

namespace lensplane::bend {

/// How a kernel's mass bends.
struct Bending {
  Law law;
  bool company;  // with what other masses add
};
inline constexpr Bending kWeak{Law::Weak, false}, kSecondOrder{Law::SecondOrder, false};
inline constexpr Bending kExact{Law::Exact, false}, kInCompany{Law::Exact, true};

/// The kernel that a mass takes.
template <class Kernel>
Kernel by_bending(const Deflector& d, Kernel weak, Kernel second_order, Kernel exact, Kernel in_company) {
  if (d.law == Law::Weak) return weak;
  if (d.law == Law::SecondOrder) return second_order;
  return d.company.weight == 0.0 ? exact : in_company;
}

template <class Number>
struct SumsBatch {
  VectorLane<Number> reference;  // the point of the ray nearest to the plane's centre
  Lane<Number> ahead;            // from the start to there
  VectorLane<Number> bend, kink, shift, outward;
  Lane<double> arc;
};

template <class Number>
LENSPLANE_ALWAYS_INLINE inline void begin_sum(int i, const Vec3& centre, const LineBatch<Number>& rays,
                                              SumsBatch<Number>& sums) {
  const Vector<Number> zero = constant<Number>(Vec3(0));
  const Vector<Number> direction = rays.direction.get(i);
  const Vector<Number> start = rays.start.get(i);
  const Number ahead = dot(difference(constant<Number>(centre), start), direction);
  sums.reference.set(i, sum(start, scaled(direction, ahead)));
  sums.ahead.set(i, ahead);
  sums.bend.set(i, zero);
  sums.kink.set(i, zero);
  sums.shift.set(i, zero);
  sums.outward.set(i, zero);
  sums.arc.v[i] = 0.0;
}

/// Where a ray passes a mass.
struct Passed {
  bool ahead;  // of the camera
  double b2;   // square of the impact parameter
};

template <class Number, Bending bending, Reach reach, bool finite, bool path>
LENSPLANE_ALWAYS_INLINE inline Passed add_to_sum(int i, const Deflector& deflector,
                                                 const LineBatch<Number>& rays, SumsBatch<Number>& sums) {
  constexpr Law law = bending.law;
  const Vector<Number> mass = constant<Number>(deflector.position);
  const Vector<Number> direction = rays.direction.get(i);
  const Vector<Number> to_mass = difference(mass, sums.reference.get(i));
  const Number along = dot(to_mass, direction);
  const Vector<Number> across = difference(to_mass, scaled(direction, along));
  const Number b2 = dot(across, across);
  Strength<Number> strength;
  bool ahead = true;
  if constexpr (finite) {
    const Number from_camera = dot(mass, direction);
    ahead = value_of(from_camera) >= 0.0;
    strength = finite_strength<law, reach>(deflector, b2, from_camera);
    sums.outward.set(i, sum(sums.outward.get(i), scaled(across, Number(deflector.index - 1.0))));
  } else {
    strength = full_strength<law, reach>(deflector.m, measured<law, reach>(b2));
  }
  if constexpr (bending.company) strength = with_company(deflector.company, b2, strength);
  const Vector<Number> bend = scaled(across, strength.per_b);
  sums.bend.set(i, sum(sums.bend.get(i), bend));
  sums.kink.set(i, sum(sums.kink.get(i), scaled(bend, along)));
  sums.shift.set(i, sum(sums.shift.get(i), scaled(bend, strength.arc)));
  if constexpr (path) sums.arc.v[i] += value_of(strength.arc);
  return {ahead, value_of(b2)};
}

}  // namespace lensplane::bend
