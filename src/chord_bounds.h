// SPDX-License-Identifier: Apache-2.0
//
// How far `planes` misplaces bodies near masses, for the rays of a tile.
//
// Round a mass `planes` knows the light's path to first order in m only, and follows it by chords. Where
// light that passes the mass at b meets a body, r from the mass, it is aside of its place by at most
//
//   m^2 [C1 b/max(r, b)^2 + C2 b r/D^3],     C1 = 1.25 + 3 (b_c/b)^3,     C2 = 3 + 12 (30 m/D)^4,
//
// D being the distance of the camera from the mass, b <= D. The first term is the path's; the second is what
// the bend of a finite distance leaves out, and grows with the way to the body. So much was found, less a
// quarter and a sixth, against curved rays round single masses in all directions: from D = 30 m on, from
// b = 1.4 b_c on, and for light nearer than that (with C1 = 1.25) where it is farther than that from the
// mass. Nearer to it, where light may be captured or wind round the mass, there is no bound. To a sphere a
// stretch is a straight line (finite_shift.h): C1 is larger by 2.5, and all of it over the sine of the angle
// at which the sphere is met.

#pragma once

#include "src/bundle_way.h"
#include "src/scene.h"

namespace lensplane {

/// From here on the formula holds: a camera nearer to a mass than this, over m, sees bodies without a bound.
inline constexpr double kChordCamera = 30.0;

/// May any ray of the bundle meet the body (in camera axes)? Surely not where this is false.
bool may_meet(const BundleWay& way, const Surface& body);

/// By how much a body that they may meet is misplaced at most, as an angle at the camera, radians; infinite
/// where there is no bound.
double misplaced_by_chords(const BundleWay& way, const Surface& body);

/// Metres from a point to a body, 0 inside it.
double gap_to_body(const Surface& surface, const Vec3& point);

}  // namespace lensplane
