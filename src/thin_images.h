// SPDX-License-Identifier: Apache-2.0
//
// Every image of a sphere or ring that is thinner than a few pixels: where rays through the centres of pixels
// may miss it.
//
// The film is cut into squares of 64 pixels, and those again and again into quarters where a thin image may
// be, down to pixels; beyond, where light passes so near to a mass that its bends are not linear across a
// pixel. A square knows of an image that lies in it: so none is found twice. The cost grows with the squares
// that hold thin images, and with the masses.
//
// Not found are images within kStrongField of a mass, or within about a third of a pixel of it, and all but
// one of several images of the same body within one such square.

#pragma once

#include <cstddef>
#include <vector>

#include "src/image_rays.h"

namespace lensplane {

/// Images of spheres and of rings are thin where they are not wider than this across, in pixels: wider ones
/// the rays of pixels find, and sample well.
inline constexpr double kThinSphere = 6, kThinRing = 2;

/// The thin part of a body's image within a square of the film, a pixel or a part of one.
struct ThinImage {
  std::size_t surface;  // whose
  FilmSquare square;
  BodyImage image;
};

/// All that lie on `tracer`'s film, overscan included, or within `margin` pixels of it; by squares of the
/// film, row by row. Runs in parallel; the images do not depend on the number of threads.
std::vector<ThinImage> find_thin_images(const Tracer& tracer, int margin);

/// Traces the same rays as `tracer`, by `geodesic` more exactly: to a small part of the smallest images.
Tracer exact_enough_for_thin(const Tracer& tracer);

}  // namespace lensplane
