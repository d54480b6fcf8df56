// SPDX-License-Identifier: Apache-2.0
//
// Pixels that one ray does for, but one footprint does not: seen as many narrower ones, without further rays.
//
// A footprint is straight. Where the map bends within a pixel - in the folds inside of Einstein rings, at the
// limbs of spheres - its image is none of an ellipse. And where a surface with holes lies before another, the
// mean of what shines through is not the mean of one times the mean of the other: a line may hide just what
// lies behind it. There the pixel filter is taken as a sum of narrower ones. Each looks from its own place in
// the pixel, found from the Jacobian and the second derivatives that differences of Jacobians between
// neighbours give; all surfaces are laid over one another in each.

#pragma once

#include <span>
#include <vector>

#include "pipeline/composite/edge_finder.h"
#include "pipeline/composite/layering.h"

namespace lensplane {

/// The second derivatives of (s, t) by the film position, per pixel squared.
struct Bend {
  double s_xx = 0, s_xy = 0, s_yy = 0;
  double t_xx = 0, t_xy = 0, t_yy = 0;
};

/// From the footprints of a pixel's four neighbours.
Bend bend_between(const Footprint& left, const Footprint& right, const Footprint& above,
                  const Footprint& below);

/// A Gaussian `scale` times as wide as the pixel filter, its place in pixels from the pixel's centre, and
/// what it counts of the whole.
struct PixelPart {
  double x, y, weight, scale;
};

/// Parts that together are the pixel filter; their weights add up to 1.
std::span<const PixelPart> bent_parts();  // 25, for bent footprints
std::span<const PixelPart>
veil_parts();  // 121 that are half as wide: what shines through is wrong within each

/// What is seen from a part of a pixel whose centre sees `centre`: where it is, and its Jacobian there. The
/// mean that the bend makes over a part is counted.
SeenPoint seen_from(const SeenPoint& centre, const Bend& bend, const PixelPart& part);

/// What a pixel of the grid sees that is `kind`: Smooth or Bent. `surfaces` as the tracer's.
Rgba see_pixel(const CentreGrid& grid, const std::vector<Surface>& surfaces, int column, int row,
               PixelKind kind, Viewer& viewer);

}  // namespace lensplane
