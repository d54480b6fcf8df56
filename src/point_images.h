// SPDX-License-Identifier: Apache-2.0
//
// Every image of points at infinity: where on the film each is seen, and how bright.
//
// The film is cut into cells of a few pixels, and cells into quarters wherever the map from film to sky is
// not nearly linear: near masses, shadows and critical curves, there only where points are seen. In each cell
// that is regular (film_cell.h) every point of its piece of sky has one image, found by Newton's method. The
// cost grows with the cells and with the images, not with their product. A scene without masses needs no
// cells: the projection's inverse says where points are.
//
// Images of a thin band along critical curves, narrower than kLeastCell, may be lost; a pair of images
// vanishes there anyway. So may those that a mass much smaller in view than a pixel makes, if other masses
// move it away from where it would be seen without them.

#pragma once

#include <vector>

#include "src/direction_index.h"
#include "src/image_newton.h"

namespace lensplane {

/// Which images are looked for.
struct ImageSearch {
  double margin_px = 4;                // beyond the film's edge, overscan included
  double least_magnification = 1e-3;   // fainter images are left out
  double largest_magnification = 1e4;  // of all images of a point together: more is scaled down to it, since
                                       // on a caustic there is no limit, but stars are no points
};

/// Cells are not divided below this, in pixels.
inline constexpr double kLeastCell = 1.0 / 32.0;

/// All images of `points` that `tracer`'s camera sees beyond all masses; its surfaces are not in the way. By
/// rising number of the point, then from the top. A lat-long film that goes on round the sphere shows points
/// more than once. Runs in parallel; the images do not depend on the number of threads.
std::vector<PointImage> find_point_images(const Tracer& tracer, const DirectionIndex& points,
                                          const ImageSearch& search = {});

}  // namespace lensplane
