// SPDX-License-Identifier: Apache-2.0
//
// The light of a sun that is seen as a disc, in closed form: how much of it a ball leaves free, and how much
// a surface has of it whose horizon cuts it.
//
// Discs are circles on the sky, evenly bright. All angles are in radians; a sun without a size is a point.

#pragma once

namespace lensplane {

/// The share, from 0 to 1, of a sun of the angular radius `sun` that a ball of the angular radius `ball`
/// leaves free, whose middles are `apart`: 0 in the umbra, between in the penumbra, and in the antumbra where
/// the ball is the smaller one. Radii below a right angle.
double free_share(double sun, double ball, double apart);

/// By Lambert's law the light of a sun of the angular radius `sun`, as a share of what it would be overhead
/// as a point: `sine` is that of the height of its middle above the horizon.
double lambert_share(double sun, double sine);

}  // namespace lensplane
