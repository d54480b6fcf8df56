// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/edge_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/batch.h"

namespace lensplane {
namespace {

/// From a pixel to its neighbour.
struct Step {
  int x, y;
};

/// What the grid sees of one surface, quantity by quantity, for loops over its rows.
struct Field {
  bool globe;
  std::vector<double> hit;  // 0 or 1; all else is 0 where it is 0
  std::vector<double> s, t, ds_dx, ds_dy, dt_dx, dt_dy;
  std::vector<double> mirrored;  // 0 or 1
  std::vector<double> width;     // how far s goes, against t: on a globe twice as far, less towards the poles
  std::vector<double> reach;     // the way to the next pixel, squared

  Field(const CentreGrid& grid, std::size_t surface, bool is_globe) : globe(is_globe) {
    for (auto* values : {&hit, &s, &t, &ds_dx, &ds_dy, &dt_dx, &dt_dy, &mirrored, &width, &reach}) {
      values->resize(grid.size());
    }
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (grid.points(i)[surface].hit) set(i, grid.points(i)[surface]);
    }
  }

  void set(std::size_t i, const SeenPoint& point) {
    const Footprint& f = point.footprint;
    hit[i] = 1;
    s[i] = point.st.s, t[i] = point.st.t;
    ds_dx[i] = f.ds_dx, ds_dy[i] = f.ds_dy, dt_dx[i] = f.dt_dx, dt_dy[i] = f.dt_dy;
    mirrored[i] = f.ds_dx * f.dt_dy > f.ds_dy * f.dt_dx ? 1 : 0;
    width[i] = globe ? 2.0 * std::sin(std::numbers::pi * point.st.t) : 1.0;
    reach[i] =
        width[i] * width[i] * (f.ds_dx * f.ds_dx + f.ds_dy * f.ds_dy) + f.dt_dx * f.dt_dx + f.dt_dy * f.dt_dy;
  }
};

static_assert(PixelKind::Smooth < PixelKind::Bent && PixelKind::Bent < PixelKind::Curved &&
              PixelKind::Curved < PixelKind::Silhouette);

/// Adds to `apart`, as numbers of PixelKind, which of `count` pixels side by side, from number `a` on, are
/// not where their neighbours from number `b` on expect them: one of the two sees the surface and the other
/// does not, or sees it mirrored, or is far from where the Jacobians put it, by the mean of both, so that
/// what is left are third derivatives and whatever has no derivative; and where the Jacobian changes much.
LENSPLANE_KERNEL void find_apart(const Field& field, std::size_t a, std::size_t b, int count, Step step,
                                 double* apart) {
  const double *hit = field.hit.data(), *s = field.s.data(), *t = field.t.data();
  const double *ds_dx = field.ds_dx.data(), *ds_dy = field.ds_dy.data();
  const double *dt_dx = field.dt_dx.data(), *dt_dy = field.dt_dy.data();
  const double *mirrored = field.mirrored.data(), *width = field.width.data(), *reach = field.reach.data();
  const double x = 0.5 * step.x, y = 0.5 * step.y, seam = field.globe ? 1.0 : 0.0;
  constexpr double kMost = kMostCurved * kMostCurved;
  const double straight_enough = kMostBent * kMostBent * (step.x * step.x + step.y * step.y);
  const auto square = [](double v) { return v * v; };
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const std::size_t m = a + static_cast<std::size_t>(i), n = b + static_cast<std::size_t>(i);
    const double straight = s[n] - s[m];
    const double ds = straight - seam * (straight > 0.5 ? 1.0 : straight < -0.5 ? -1.0 : 0.0);
    const double off_s = width[m] * (ds - ((ds_dx[m] + ds_dx[n]) * x + (ds_dy[m] + ds_dy[n]) * y));
    const double off_t = t[n] - t[m] - ((dt_dx[m] + dt_dx[n]) * x + (dt_dy[m] + dt_dy[n]) * y);
    const double least = reach[m] < reach[n] ? reach[m] : reach[n];
    const bool near = (off_s * off_s + off_t * off_t <= kMost * least) & (mirrored[m] == mirrored[n]);
    const bool same = hit[m] == hit[n];
    const double change = square(width[m]) * (square(ds_dx[n] - ds_dx[m]) + square(ds_dy[n] - ds_dy[m])) +
                          square(dt_dx[n] - dt_dx[m]) + square(dt_dy[n] - dt_dy[m]);
    const double found = same ? (near ? (change > straight_enough * least ? 1.0 : 0.0) : 2.0) : 3.0;
    apart[i] = apart[i] > found ? apart[i] : found;
  }
}

/// Whether two rays meet surfaces in different orders.
bool are_reordered(std::span<const SeenPoint> a, std::span<const SeenPoint> b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t n = 0; a[k].hit && n < k; ++n) {
      if (a[n].hit && (a[k].distance < a[n].distance) != (b[k].distance < b[n].distance)) return true;
    }
  }
  return false;
}

}  // namespace

bool meet_alike(std::span<const SeenPoint> a, std::span<const SeenPoint> b) {
  const auto same = [](const SeenPoint& p, const SeenPoint& q) { return p.hit == q.hit; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same) && !are_reordered(a, b);
}

CentreGrid::CentreGrid(const std::vector<Surface>& surfaces, int width, int height)
    : surfaces_(surfaces),
      width_(width),
      height_(height),
      points_(size() * surfaces.size()),
      captured_(size(), 0) {}

std::vector<PixelKind> CentreGrid::kinds() const {
  std::vector<PixelKind> kinds(size(), PixelKind::Smooth);
  const auto any = [](const auto& all, auto is) { return std::any_of(all.begin(), all.end(), is); };
  if (!any(points_, [](const SeenPoint& p) { return p.hit; }) &&
      !any(captured_, [](std::uint8_t captured) { return captured != 0; }))
    return kinds;
  std::vector<Field> fields;
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    const Surface& surface = surfaces_[k];
    fields.emplace_back(*this, k,
                        std::holds_alternative<LatLong>(surface) || std::holds_alternative<Sphere>(surface));
  }
  std::vector<double> apart(static_cast<std::size_t>(full_width()));
  for (int row = -1; row <= height_; ++row) {
    for (const Step step : {Step{1, 0}, Step{-1, 1}, Step{0, 1}, Step{1, 1}}) {
      if (row + step.y > height_) continue;
      const int first = step.x < 0 ? 0 : -1, count = full_width() - std::abs(step.x);
      const std::size_t at = place(first, row), next = place(first + step.x, row + step.y);
      std::fill(apart.begin(), apart.end(), 0.0);
      for (const Field& field : fields) find_apart(field, at, next, count, step, apart.data());
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        auto found = static_cast<PixelKind>(apart[i]);
        const bool reordered = fields.size() > 1 && are_reordered(points(at + i), points(next + i));
        if (reordered || captured(at + i) != captured(next + i)) found = PixelKind::Silhouette;
        if (found == PixelKind::Smooth) continue;
        for (PixelKind* kind : {&kinds[at + i], &kinds[next + i]}) *kind = std::max(*kind, found);
      }
    }
  }
  return kinds;
}

}  // namespace lensplane
