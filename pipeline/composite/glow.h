// SPDX-License-Identifier: Apache-2.0
//
// Veiling glare: a share of the light is scattered in the camera and spreads over the picture.
//
// Every point of light keeps 1 - strength of itself; the rest follows the point-spread
//   P(r) = r0 / (2 pi (r^2 + r0^2)^(3/2)),  r0 = radius / sqrt(3),
// whose integral over the plane is 1 and of which half lies within `radius`. Its tail falls like r^-3, as the
// glare of the eye and of lenses does (Spencer et al. 1995, whose widest term it is). P is made of Gaussians,
// each about 1.4 times as wide as the one before, with weights that add up to 1: the picture is halved again
// and again, blurred at every size, and added up on the way back. How well they follow P is kGlowError.
//
// What lies outside of the data window is as bright as its edge: the overscan is what light from outside the
// frame is taken from, where there is some. A lat-long picture goes on round the sphere and over its poles,
// the circle of a fisheye as bright as its rim; outside of it there stays nothing. So what is bright alike
// everywhere stays so.

#pragma once

#include "pipeline/image/picture.h"
#include "src/scene.h"

namespace lensplane {

struct Glow {
  double strength = 0;                              // share of the light that is scattered, 0 to 1
  double radius_px = 0;                             // radius of the circle that holds half of it, > 0
  Projection projection = Projection::Perspective;  // of the camera
};

/// The largest relative error of the point-spread within 30 radii, from a radius of 10 pixels on.
inline constexpr double kGlowError = 0.04;

/// The picture with its glow; alpha stays as it is. Runs in parallel; the picture does not depend on the
/// number of threads.
Picture with_glow(const Picture& picture, const Glow& glow);

}  // namespace lensplane
