// SPDX-License-Identifier: Apache-2.0
//
// The shift of a stretch by one mass (finite_shift.h), without branches: single rays and batches share it.

#pragma once

#include "src/deflectors.h"
#include "src/inlining.h"
#include "src/ray_path.h"

namespace lensplane {

/// Has a mass bent a stretch?
enum class Bent {
  NotYet,
  JustNow,  // by the plane at its start; the mass's own foot point may still lie ahead
  Before,
};

/// The same for the masses of plane number `plane`, of a stretch that `bends` planes have bent.
constexpr Bent bent_by_plane(int plane, int bends) {
  return plane >= bends ? Bent::NotYet : plane == bends - 1 ? Bent::JustNow : Bent::Before;
}

// The formulas of finite_shift.h over 2 m b, without cancellation.

template <class Number>
LENSPLANE_ALWAYS_INLINE inline Number shift_before(const Number& z, const Number& z_camera,
                                                   const Number& b2) {
  const Number r = sqrt(z * z + b2);
  const Number r_camera = sqrt(z_camera * z_camera + b2);
  const Number product = z * z_camera;
  const bool apart = value_of(product) < 0.0;
  const Number numerator = select(apart, z * z + z_camera * z_camera + b2, r * r_camera + product);
  const Number denominator = select(apart, r * r_camera - product, b2);
  return (numerator / denominator - 1.0) / r_camera;
}

template <class Number>
LENSPLANE_ALWAYS_INLINE inline Number shift_after(const Number& z, const Number& b2) {
  const Number r = sqrt(z * z + b2);
  const bool ahead = value_of(z) < 0.0;
  return select(ahead, r - z, Number(1.0)) / select(ahead, b2, r + z);
}

/// The shift of a stretch, `way` metres from its start. A mass that the light, having turned back, comes
/// towards again counts as if beside it; the light does not pass it on the other side.
template <class Number>
LENSPLANE_ALWAYS_INLINE inline Vector<Number> shift_by_mass(const Deflector& deflector, Bent bent,
                                                            const Vector<Number>& start,
                                                            const Vector<Number>& direction,
                                                            const Number& way) {
  const Vector<Number> mass = constant<Number>(deflector.position);
  const Vector<Number> to_mass = mass - start;
  const Number along = to_mass.dot(direction);
  const Vector<Number> across = to_mass - direction * along;
  const Number distance2 = across.dot(across);
  const bool aside = value_of(distance2) > 0.0;
  const Number b2 = select(aside, distance2, Number(1.0));
  const Number beyond = way - along;
  const bool returns = bent == Bent::Before && value_of(beyond) < 0.0;
  const Number z = select(returns, Number(0.0), beyond);
  const Number share = bent == Bent::NotYet ? shift_before(z, mass.dot(direction), b2) : shift_after(z, b2);
  const Number shift = 2.0 * deflector.m * share;
  const bool past = returns && value_of(shift) > 1.0;
  return across * select(aside, select(past, Number(1.0), shift), Number(0.0));
}

}  // namespace lensplane
