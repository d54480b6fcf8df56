// SPDX-License-Identifier: Apache-2.0
//
// What the finite distance of a light source changes: near a mass, light runs beside the straight stretches
// of its path, which are its asymptotes. To first order in m, beyond the closest approach by
//
//   2 m (r - z)/b = 2 m b/(r + z),   r = hypot(z, b),
//
// towards the mass, z being the way from there, negative before it. Before it by
//
//   (2 m/b) (r + (z z_c - b^2)/r_c),   r_c = hypot(z_c, b),
//
// z_c being the way from the camera to the closest approach, positive for a mass ahead: so it is 0 at the
// camera, z = -z_c (integrate d^2y/dz^2 = -2 m b/r^3 from there).

#pragma once

#include "src/deflectors.h"
#include "src/ray_path.h"

namespace lensplane {

/// By how much the light runs beside its straight stretch, `way` metres from the stretch's start.
template <class Number>
Vector<Number> finite_shift(const Deflectors& deflectors, const RaySegment<Number>& stretch,
                            const Number& way);

/// A straight stretch as it truly runs at a body that it meets, or else comes nearest to, `way` metres from
/// its start: from its own shifted start through its shifted point there.
template <class Number>
RaySegment<Number> shifted(const Deflectors& deflectors, const RaySegment<Number>& stretch,
                           const Number& way);

/// The chord from the shifted end of one stretch to the shifted start of the next.
template <class Number>
RaySegment<Number> chord_between(const Deflectors& deflectors, const RaySegment<Number>& in,
                                 const RaySegment<Number>& out);

/// The straight line from `start` to `end`.
template <class Number>
RaySegment<Number> straight_between(const Vector<Number>& start, const Vector<Number>& end,
                                    const RaySegment<Number>& along);

}  // namespace lensplane
