// SPDX-License-Identifier: Apache-2.0
//
// The vocabulary of lensplane: one instant of a shot, as plain data.
//
// World: right-handed, y up, metres, double precision. Film: x to the right, y down from the top row, in
// pixels; the centre of the first pixel is (0.5, 0.5).

#pragma once

#include <variant>
#include <vector>

#include "src/basis.h"

namespace lensplane {

// Perspective  straight lines stay straight; square pixels
// LatLong      the whole sphere over the frame, longitude by latitude; no field of view
// Fisheye      equidistant: pixels from the centre in proportion to the angle from the axis; square pixels
enum class Projection { Perspective, LatLong, Fisheye };

/// Where the scene is seen from, and how it comes onto the film.
struct Camera {
  int width = 0;     // pixels of the output frame
  int height = 0;    // pixels of the output frame
  int overscan = 0;  // further pixels on every side; the field of view does not count them
  Projection projection = Projection::Perspective;
  double fov_rad = 0;  // full angle: perspective across `width`, in (0, pi); fisheye across its circle, the
                       // largest that the frame holds, in (0, 2 pi]; of no meaning for lat-long
  Vec3 position{0};    // metres
  Basis axes;          // world from camera: looks along -z, +x to the right, +y up

  int full_width() const { return width + 2 * overscan; }    // overscan included
  int full_height() const { return height + 2 * overscan; }  // overscan included
};

/// A point mass.
struct Lens {
  double m = 0;      // geometric mass G M / c^2, metres, >= 0
  Vec3 position{0};  // metres
};

/// A picture at infinity that fills the camera's frame when nothing is lensed.
/// (s, t): (0, 0) is the frame's lower left corner, (1, 1) its upper right. Outside the frame they go on.
struct Plate {
  bool bent = false;  // a picture of light that was bent already: every film position sees its own place on
                      // it, wherever its light goes
};

/// A picture around everything, at infinity. s = .5 looks along the world's -z, s = .75 along +x; t = 1 is
/// up.
struct LatLong {};

/// An opaque ball, seen from outside. s = .5 is longitude 0, which lies along the body's +z, east to the
/// right; t = 1 is the north pole, along its +y.
struct Sphere {
  Vec3 centre{0};     // metres
  double radius = 0;  // metres, > 0
  Basis axes;         // world from body
};

/// A flat annulus, seen from both sides; light goes on through it, so that it may be met more than once.
/// s is 0 on its inner edge and 1 on its outer one; t = .5 lies along the ring's +z and grows towards +x, as
/// longitudes do; its seam, where t jumps from 1 to 0, lies along -z.
struct Ring {
  Vec3 centre{0};    // metres
  Basis axes;        // world from ring; +y is its normal
  double inner = 0;  // metres, >= 0
  double outer = 0;  // metres, > inner
  int crossing = 0;  // which of a ray's crossings of the annulus is seen, from 0
};

/// A plate at a finite distance: the plane z = -distance in camera axes, seen from both sides, as a
/// photograph on glass is. (s, t) as of Plate: without lenses it fills the camera's frame. The plane goes on
/// beyond the picture's edges; a panoramic camera sees it in front of it only.
struct Card {
  double distance = 0;  // metres along the camera's axis, > 0
  int crossing = 0;     // which of a ray's crossings of the plane is seen, from 0; odd ones from behind
};

using Surface = std::variant<Plate, LatLong, Sphere, Ring, Card>;

/// Everything that determines where light goes at one instant.
struct Scene {
  Camera camera;
  std::vector<Lens> lenses;
  std::vector<Surface> surfaces;
};

}  // namespace lensplane
