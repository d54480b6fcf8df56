// SPDX-License-Identifier: Apache-2.0
//
// A square cell of the film and the piece of sky that is seen through it, as far as five rays tell: through
// its corners and its centre.
//
// With A the map's derivatives at the centre, a map with |A^-1 J - 1| < 1 everywhere in the cell takes no two
// of its points to the same place (it differs from A by a contraction). A cell for which this holds with room
// to spare at its corners is regular: every point of the sky has at most one image in it, which Newton's
// method finds from the centre. Cells that are not are divided.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "src/direction_index.h"
#include "src/sky_rays.h"

namespace lensplane {

struct FilmCell {
  double size = 0;                // pixels
  std::array<SkyRay, 4> corners;  // upper left, upper right, lower left, lower right
  SkyRay centre;
};

/// Two unit vectors perpendicular to a unit vector and to each other: small pieces of sky, seen flat.
struct TangentPlane {
  Vec3 u, v;
};
TangentPlane tangent_plane(const Vec3& direction);

/// The derivatives of a ray's direction on a plane, per pixel: (u, v) by (x, y).
struct FilmJacobian {
  double u_x, u_y, v_x, v_y;

  double determinant() const { return u_x * v_y - u_y * v_x; }
};
FilmJacobian jacobian_on(const TangentPlane& plane, const SkyRay& ray);

/// The film shift that moves what is seen by (u, v); `jacobian` has a determinant.
FilmPosition film_shift(const FilmJacobian& jacobian, double u, double v);

/// A cell is regular when A^-1 J differs from 1 by less than this at its corners.
inline constexpr double kRegularBend = 0.5;

/// The sky seen through a cell.
struct CellView {
  SkyPatch patch;                    // what the corners see; no band where rays are missing
  bool regular = false;              // see above
  bool wild = true;                  // derivatives change by their own size, or rays are missing
  double bend = 0;                   // regular cells: by how much A^-1 J differs from 1
  double largest_magnification = 0;  // of the five rays, without sign
};
CellView view_of(const FilmCell& cell);

/// The patch `reach` times as large, and wider by `bow` times the chord: what a cell may see besides.
SkyPatch grown(SkyPatch patch, double reach, double bow);

/// The map from a cell to the sky to second order, where all its rays are seen.
struct CellMap {
  FilmPosition centre{0, 0};
  Vec3 middle{0};                     // what is seen at the centre
  TangentPlane plane{};               // there
  FilmJacobian first{};               // derivatives at the centre; with a determinant for film_of
  FilmJacobian first_x{}, first_y{};  // their derivatives by x and y, per pixel

  /// About where in the cell a direction is seen: in a regular cell the error is about the bend squared, in
  /// cells.
  FilmPosition film_of(const Vec3& direction) const;
};
CellMap map_of(const FilmCell& cell);

/// The square cells of `size` pixels, row by row, whose upper left corner is `corner`.
std::vector<FilmCell> trace_cells(const SkyRays& rays, FilmPosition corner, double size, int columns,
                                  int rows);

/// The four quarters of every cell.
std::vector<FilmCell> trace_quarters(const SkyRays& rays, std::span<const FilmCell> cells);

}  // namespace lensplane
