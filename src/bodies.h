// SPDX-License-Identifier: Apache-2.0
//
// Bodies: surfaces at a finite distance, which light meets on its way: spheres, rings and cards. Where they
// are met, and what is seen there.
//
// Bodies and rays are in camera axes. Templates over the number type as in surfaces.h.

#pragma once

#include "src/inlining.h"
#include "src/surfaces.h"

namespace lensplane {

/// Does the surface stand at a finite distance?
bool is_body(const Surface& surface);

/// Distance at which a ray (unit `direction`) enters the ball; infinite when it does not.
template <class Number>
Number sphere_entry(const Vector<Number>& start, const Vector<Number>& direction, const Vec3& centre,
                    double radius);

/// Metres along a stretch of that length to where it enters the ball, or else is nearest to its centre.
/// Without branches, for loops over batches, which do not keep the derivatives of the length.
template <class Number>
LENSPLANE_ALWAYS_INLINE inline Number way_to_ball(const Sphere& sphere, const Vector<Number>& start,
                                                  const Vector<Number>& direction, double length) {
  const Vector<Number> to_centre = constant<Number>(sphere.centre) - start;
  const Number along = to_centre.dot(direction);
  const Vector<Number> across = to_centre - direction * along;
  const Number half_chord2 = Number(sphere.radius * sphere.radius) - across.dot(across);
  const bool enters = value_of(half_chord2) > 0.0;
  const Number way = select(enters, along - sqrt(select(enters, half_chord2, Number(1.0))), along);
  return select(value_of(way) > 0.0, select(value_of(way) < length, way, Number(length)), Number(0.0));
}

/// A straight stretch as it truly runs at the ball; see finite_shift.h.
template <class Number>
RaySegment<Number> shifted_to_ball(const Deflectors& deflectors, const RaySegment<Number>& stretch,
                                   const Sphere& sphere);

/// The point `point` of a body as the ray through `film` sees it: outcome and (s, t). `first`, the direction
/// in which the ray left, counts for cards alone. `surface` has to be a body.
template <class Number>
SurfaceHit<Number> meet_body_at(const Surface& surface, const Camera& camera, FilmPosition film,
                                const Vector<Number>& first, const Vector<Number>& point);

/// How much larger a body appears at `point` than it would without masses, to a ray that left along `first`.
double magnification_on_body(const Surface& surface, const DualVec3& first, const DualVec3& point);

/// What a path meets on a body: on a sphere where it first enters. `finite` as of meet().
template <class Number>
SurfaceHit<Number> meet_body(const Surface& surface, const Camera& camera, FilmPosition film,
                             const RayPath<Number>& path, const Deflectors* finite);

}  // namespace lensplane
