// SPDX-License-Identifier: Apache-2.0
//
// How much can be left out: bounds, in pixels, on how far each simplification moves what is seen, tile by
// tile.
//
// The rays of a tile are a bundle round its middle ray, which is traced with everything on. What is known of
// the others is how far they are from it at most: they spread by their angle on straight stretches, and at a
// mass by at most as much more as its bend can differ between them, (|d alpha/db| at their smallest impact
// parameter) x (their distance). So each mass has a smallest impact parameter in the tile, at which the
// bounds of deflection.h hold for all of the tile's rays. In the same way an error of one bend grows on its
// way through the masses behind it; that growth is followed backwards from the end of the ray. The bounds of
// all bends, each with its growth, are added up: they never cancel here, as in truth they often do.
//
// Two things have no useful bound. A tile is wild when light of it may pass a mass within kWildRatio b_c,
// where bends grow without limit, or so near that errors grow more than kWildGrowth times (a few times nearer
// than the Einstein radius), or turns back, or spreads so far that nothing is known of it: there everything
// is simulated. And light that passes a mass nearer than kUnseenPixels of a pixel is left out of account: a
// mass that moves nothing else is not seen on any film.
//
// What chords misplace is no simplification of these: it counts also where everything else is simulated, and
// in wild tiles (chord_bounds.h).

#pragma once

#include <vector>

#include "src/plan.h"

namespace lensplane {

/// Within so many times b_c of a mass, everything is simulated.
inline constexpr double kWildRatio = 1.5;

/// Where a plane lets an error of direction grow by more than this, everything is simulated.
inline constexpr double kWildGrowth = 20.0;

/// Passing a mass nearer than this, in pixels, does not count.
inline constexpr double kUnseenPixels = 1e-3;

/// What one tile leaves out, summed over all lenses, in pixels.
struct TileBound {
  bool wild = false;
  double weak_px = 0;          // all laws weak
  double second_order_px = 0;  // all laws of second order
  double gain_px = 0;          // every mass by itself (company.h)
  double joint_px = 0;         // what masses do together and no law knows
  double chords_px = 0;        // bodies met by chords instead of curved rays; infinite where nothing is known
};

/// What leaving out one lens, or a part of it, would move at most on all tiles that are not wild, in pixels.
struct LensBound {
  double moves_px = 0;         // left out as a whole
  double weak_px = 0;          // by the weak law
  double second_order_px = 0;  // by the second order
  double gain_px = 0;          // by the exact law of a mass by itself (company.h)
  double finite_px = 0;        // without the finite distances of camera and surfaces
  bool wild = false;           // makes a tile wild
};

struct FilmBounds {
  std::vector<TileBound> tiles;   // row by row
  std::vector<LensBound> lenses;  // by number in the scene; of bodies that are one, at the first
};

/// Bounds for `scene` over `tiles` of its film. `everything` are its deflectors with everything on.
FilmBounds bounds_of(const Scene& scene, const Deflectors& everything, const TileLevels& tiles);

}  // namespace lensplane
