// SPDX-License-Identifier: Apache-2.0
//
// Where light comes from that a static observer sees past one mass, in closed form: what curved rays are
// checked against.
//
// Light of impact parameter b that is nearest to the mass at the Schwarzschild radius P sweeps, from there to
// the radius r (C. Darwin 1959),
//   phi(r) = 2 sqrt(P/Q) [K(k) - F(z, k)],  sin^2 z = (Q - P + 2m + 4m P/r)/(Q - P + 6m),
// with Q^2 = (P - 2m)(P + 6m) and k^2 = (Q - P + 6m)/(2Q): elliptic integrals of the first kind.

#pragma once

#include <optional>

#include "src/basis.h"

namespace lensplane {

/// Angle about the mass from the observer to where the light comes from, radians; grows without limit towards
/// the shadow's edge. `rho`: the observer's isotropic distance, metres; `chi`: the angle at which the light
/// is seen from the direction of the mass. schwarzschild_sweep(1, rho of r = 15 m, 20 deg) =
/// 302.96583194611962 deg. Nothing where the light is captured, and within the photon sphere, of which
/// nothing is said here.
std::optional<double> schwarzschild_sweep(double m, double rho, double chi);

/// The direction, a unit vector, in which light would be seen that is seen along `direction` (a unit vector)
/// past the mass `m` at `position` from the observer, if the mass were not there: where it comes from at
/// infinity. Nothing where schwarzschild_sweep has nothing.
std::optional<Vec3> sky_direction_past(double m, const Vec3& position, const Vec3& direction);

}  // namespace lensplane
