// SPDX-License-Identifier: Apache-2.0

#include "src/film_cell.h"

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

/// Derivatives that change by more than this, against their own size, are wild.
constexpr double kWild = 0.5;

/// Pieces of sky that reach farther from their middle, as a chord, are not seen flat.
constexpr double kFlat = 0.7;

double size_of(const FilmJacobian& j) {
  return std::sqrt(j.u_x * j.u_x + j.u_y * j.u_y + j.v_x * j.v_x + j.v_y * j.v_y);
}

FilmJacobian difference(const FilmJacobian& a, const FilmJacobian& b) {
  return {a.u_x - b.u_x, a.u_y - b.u_y, a.v_x - b.v_x, a.v_y - b.v_y};
}

/// |A^-1 J| of the derivatives' change J between the centre and a corner, or by how much the corner lies
/// elsewhere than A says, in half diagonals of the cell, if that is more.
double bend_at(const FilmJacobian& a, const FilmJacobian& change, const TangentPlane& plane,
               const SkyRay& centre, const SkyRay& corner) {
  const FilmPosition x = film_shift(a, change.u_x, change.v_x), y = film_shift(a, change.u_y, change.v_y);
  const Vec3 away = corner.direction - centre.direction;
  const FilmPosition guess = film_shift(a, plane.u.dot(away), plane.v.dot(away));
  const double dx = corner.film.x - centre.film.x, dy = corner.film.y - centre.film.y;
  return std::max(std::sqrt(x.x * x.x + x.y * x.y + y.x * y.x + y.y * y.y),
                  std::hypot(guess.x - dx, guess.y - dy) / std::hypot(dx, dy));
}

/// The band of a patch: along the great circle from its middle to the farthest corner.
void set_band(const FilmCell& cell, SkyPatch& patch) {
  double farthest = 0;
  for (const SkyRay& corner : cell.corners) {
    const Vec3 across = patch.middle.cross(corner.direction);
    if (across.length() <= farthest) continue;
    farthest = across.length();
    patch.across = across / farthest;
  }
  for (const SkyRay& corner : cell.corners) {
    patch.width = std::max(patch.width, std::abs(patch.across.dot(corner.direction)));
  }
}

FilmPosition between(const SkyRay& a, const SkyRay& b) {
  return {(a.film.x + b.film.x) / 2.0, (a.film.y + b.film.y) / 2.0};
}

}  // namespace

TangentPlane tangent_plane(const Vec3& direction) {
  const Vec3 aside = std::abs(direction.y) < 0.7 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
  const Vec3 u = aside.cross(direction).normalized();
  return {u, direction.cross(u)};
}

FilmJacobian jacobian_on(const TangentPlane& plane, const SkyRay& ray) {
  return {plane.u.dot(ray.by_x), plane.u.dot(ray.by_y), plane.v.dot(ray.by_x), plane.v.dot(ray.by_y)};
}

FilmPosition film_shift(const FilmJacobian& j, double u, double v) {
  const double per_determinant = 1.0 / j.determinant();
  return {(j.v_y * u - j.u_y * v) * per_determinant, (j.u_x * v - j.v_x * u) * per_determinant};
}

CellView view_of(const FilmCell& cell) {
  CellView view;
  const SkyRay* middle = cell.centre.seen ? &cell.centre : nullptr;
  bool all_seen = cell.centre.seen;
  for (const SkyRay& corner : cell.corners) {
    all_seen = all_seen && corner.seen;
    if (!middle && corner.seen) middle = &corner;
  }
  if (!middle) return view;
  view.patch = {middle->direction, 0.0, Vec3(0), 0.0};
  view.largest_magnification = std::abs(cell.centre.magnification);
  for (const SkyRay& corner : cell.corners) {
    if (!corner.seen) continue;
    view.largest_magnification = std::max(view.largest_magnification, std::abs(corner.magnification));
    view.patch.chord = std::max(view.patch.chord, (corner.direction - view.patch.middle).length());
  }
  if (!all_seen) return view;
  set_band(cell, view.patch);
  if (!(view.patch.chord < kFlat)) return view;
  const TangentPlane plane = tangent_plane(view.patch.middle);
  const FilmJacobian a = jacobian_on(plane, cell.centre);
  double change = 0;
  for (const SkyRay& corner : cell.corners) {
    const FilmJacobian d = difference(jacobian_on(plane, corner), a);
    change = std::max(change, size_of(d));
    if (a.determinant() != 0.0) view.bend = std::max(view.bend, bend_at(a, d, plane, cell.centre, corner));
  }
  view.wild = change > kWild * size_of(a);
  view.regular = a.determinant() != 0.0 && view.bend < kRegularBend;
  return view;
}

SkyPatch grown(SkyPatch patch, double reach, double bow) {
  patch.width = reach * patch.width + bow * patch.chord;
  patch.chord *= reach;
  return patch;
}

CellMap map_of(const FilmCell& cell) {
  CellMap map{cell.centre.film, cell.centre.direction, tangent_plane(cell.centre.direction), {}, {}, {}};
  map.first = jacobian_on(map.plane, cell.centre);
  // What grows from one side to the other: the mean of both edges.
  const auto growth = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    const FilmJacobian p =
        difference(jacobian_on(map.plane, cell.corners[b]), jacobian_on(map.plane, cell.corners[a]));
    const FilmJacobian q =
        difference(jacobian_on(map.plane, cell.corners[d]), jacobian_on(map.plane, cell.corners[c]));
    const double half = 0.5 / cell.size;
    return FilmJacobian{(p.u_x + q.u_x) * half, (p.u_y + q.u_y) * half, (p.v_x + q.v_x) * half,
                        (p.v_y + q.v_y) * half};
  };
  map.first_x = growth(0, 1, 2, 3);
  map.first_y = growth(0, 2, 1, 3);
  return map;
}

FilmPosition CellMap::film_of(const Vec3& direction) const {
  constexpr int kRounds = 4;
  const Vec3 away = direction - middle;
  const double u = plane.u.dot(away), v = plane.v.dot(away);
  const double u_xy = 0.5 * (first_x.u_y + first_y.u_x), v_xy = 0.5 * (first_x.v_y + first_y.v_x);
  FilmPosition shift = film_shift(first, u, v);
  for (int i = 0; i < kRounds; ++i) {
    const double xx = 0.5 * shift.x * shift.x, xy = shift.x * shift.y, yy = 0.5 * shift.y * shift.y;
    shift = film_shift(first, u - (first_x.u_x * xx + u_xy * xy + first_y.u_y * yy),
                       v - (first_x.v_x * xx + v_xy * xy + first_y.v_y * yy));
  }
  return {centre.x + shift.x, centre.y + shift.y};
}

std::vector<FilmCell> trace_cells(const SkyRays& rays, FilmPosition corner, double size, int columns,
                                  int rows) {
  std::vector<FilmPosition> films;
  const auto add = [&](int wide, int high, double shift) {
    for (int j = 0; j < high; ++j) {
      for (int i = 0; i < wide; ++i)
        films.push_back({corner.x + (i + shift) * size, corner.y + (j + shift) * size});
    }
  };
  add(columns + 1, rows + 1, 0.0);
  add(columns, rows, 0.5);
  const std::vector<SkyRay> traced = rays.trace(films);
  std::vector<FilmCell> cells;
  const auto wide = static_cast<std::size_t>(columns), stride = wide + 1;
  const std::size_t centres = stride * static_cast<std::size_t>(rows + 1);
  for (std::size_t k = 0; k < wide * static_cast<std::size_t>(rows); ++k) {
    const std::size_t at = k / wide * stride + k % wide;
    cells.push_back({size,
                     {traced[at], traced[at + 1], traced[at + stride], traced[at + stride + 1]},
                     traced[centres + k]});
  }
  return cells;
}

std::vector<FilmCell> trace_quarters(const SkyRays& rays, std::span<const FilmCell> cells) {
  std::vector<FilmPosition> films;
  for (const FilmCell& cell : cells) {
    const auto& [a, b, c, d] = cell.corners;
    // The middles of the upper, left, right and lower edge, then the centres of the quarters.
    for (const auto& [p, q] : {std::pair(&a, &b), {&a, &c}, {&b, &d}, {&c, &d}})
      films.push_back(between(*p, *q));
    for (const SkyRay& corner : cell.corners) films.push_back(between(corner, cell.centre));
  }
  const std::vector<SkyRay> traced = rays.trace(films);
  std::vector<FilmCell> quarters;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto& [a, b, c, d] = cells[k].corners;
    const SkyRay* t = &traced[8 * k];
    const SkyRay& m = cells[k].centre;
    const double half = cells[k].size / 2.0;
    quarters.push_back({half, {a, t[0], t[1], m}, t[4]});
    quarters.push_back({half, {t[0], b, m, t[2]}, t[5]});
    quarters.push_back({half, {t[1], m, c, t[3]}, t[6]});
    quarters.push_back({half, {m, t[2], t[3], d}, t[7]});
  }
  return quarters;
}

}  // namespace lensplane
