// SPDX-License-Identifier: Apache-2.0
//
// The method `planes`, a ray at a time: the readable reference for the batches of planes_batch.h, and what
// traces the rays that they leave aside.
//
// A mass turns a ray's line, foot point and direction together, by alpha about itself, so that the impact
// parameter stays as it is: right for 1e-9 rad and for light that winds round it. The masses of one plane
// turn the ray by the sum of their angles, as vectors, each at its own foot point. Templates over the number
// type are instantiated for `double` and for `Dual`.
//
// With the finite distance of the camera a bend is (A. Ishihara et al. 2016, to first order in m)
//
//   alpha = (2 m/b') (1 + cos R) + [law(b') - 4 m/b'] h(cos R),    h(c) = (1 + c)^2 (2 - c)/4,
//
// where b' = n b is the impact parameter far away for a ray that starts at b here (deflectors.h), and R the
// angle at the camera between the ray's line and the mass: cos R = along/r, `along` being the way that the
// line runs from the camera to its closest approach, and r = hypot(along, b). It is 1 for a mass far ahead, 0
// beside the camera, -1 behind it. h is the share of the law's higher orders that lies ahead of the
// camera, as that of an integral of b^3/r^4 would be to within 2 %. Where a mass is behind (cos R < 0), the
// ray is never nearer to it than the camera, whose distance takes the place of b in the bracket.

#pragma once

#include <optional>

#include "src/deflectors.h"
#include "src/ray_path.h"

namespace lensplane {

/// Where light ends that a mass captures: where, to the first order of finite_shift.h, it comes into the
/// photon sphere, or else where its line is nearest to the mass.
struct Capture {
  const Deflector* mass;
  double way;  // metres from where its line begins; negative before that
};

/// The first capture of the line from `start` along `direction` by the masses of a plane, if there is any.
std::optional<Capture> capture_by(const DeflectorPlane& plane, bool finite_distance, const Vec3& start,
                                  const Vec3& direction);

/// The path from the camera along the unit vector `direction`: through the outward planes in their order;
/// light that has turned back then meets the masses in the order of their closest approaches.
/// Captured: b' <= 3 sqrt(3) m of a mass ahead; a camera inside the photon sphere sees out only away from the
/// mass, with b' < 3 sqrt(3) m, and inside a horizon not at all.
template <class Number>
RayPath<Number> march_planes(const Deflectors& deflectors, const Vector<Number>& direction);

/// The angle by which a deflector bends a ray.
template <class Number>
struct Bend {
  Number alpha;  // radians
  Number per_b;  // alpha/b, radians per metre: finite where a ray leads straight away from a mass
};

/// The bend of a ray's line with impact parameter `b`; `along` is the distance that the ray runs from the
/// camera to its closest approach, or nothing for bends without finite distance. Nothing when captured.
template <class Number>
std::optional<Bend<Number>> bend_by(const Deflector& deflector, const Number& b,
                                    const std::optional<Number>& along);

}  // namespace lensplane
