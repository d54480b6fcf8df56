// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/edge_finder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lensplane {
namespace {

/// How the picture on a surface lies about a point.
struct Lie {
  bool mirrored = false;
  double width = 1;  // how far s goes there, against t: on a globe twice as far, less towards the poles
  double reach = 0;  // the way to the next pixel, squared
};

Lie lie_of(const SeenPoint& point, bool globe) {
  const Footprint& f = point.footprint;
  Lie lie;
  lie.mirrored = f.ds_dx * f.dt_dy > f.ds_dy * f.dt_dx;
  if (globe) lie.width = 2.0 * std::sin(std::numbers::pi * point.st.t);
  lie.reach =
      lie.width * lie.width * (f.ds_dx * f.ds_dx + f.ds_dy * f.ds_dy) + f.dt_dx * f.dt_dx + f.dt_dy * f.dt_dy;
  return lie;
}

/// From a pixel to its neighbour.
struct Step {
  int x, y;
};

/// Whether two rays meet different surfaces, or the same in another order.
bool are_different(std::span<const SeenPoint> a, std::span<const SeenPoint> b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].hit != b[k].hit) return true;
    for (std::size_t n = 0; a[k].hit && n < k; ++n) {
      if (a[n].hit && (a[k].distance < a[n].distance) != (b[k].distance < b[n].distance)) return true;
    }
  }
  return false;
}

/// Whether a neighbour is far from where the Jacobians put it: by the mean of both, so that what is left are
/// third derivatives, and whatever has no derivative.
bool are_apart(const SeenPoint& a, const Lie& at_a, const SeenPoint& b, const Lie& at_b, Step step,
               bool globe) {
  if (at_a.mirrored != at_b.mirrored) return true;
  const Footprint &f = a.footprint, &g = b.footprint;
  double ds = b.st.s - a.st.s;
  if (globe) ds -= std::round(ds);
  const double off_s =
      at_a.width * (ds - 0.5 * ((f.ds_dx + g.ds_dx) * step.x + (f.ds_dy + g.ds_dy) * step.y));
  const double off_t = b.st.t - a.st.t - 0.5 * ((f.dt_dx + g.dt_dx) * step.x + (f.dt_dy + g.dt_dy) * step.y);
  return !(off_s * off_s + off_t * off_t <= kMostCurved * kMostCurved * std::min(at_a.reach, at_b.reach));
}

}  // namespace

CentreGrid::CentreGrid(const std::vector<Surface>& surfaces, int width, int height)
    : surfaces_(surfaces), width_(width), height_(height), points_(size() * surfaces.size()) {}

std::vector<std::uint8_t> CentreGrid::edges() const {
  std::vector<std::uint8_t> edges(size(), 0);
  if (std::none_of(points_.begin(), points_.end(), [](const SeenPoint& p) { return p.hit; })) return edges;
  const std::size_t count = surfaces_.size();
  std::vector<Lie> lies(points_.size());
  std::vector<bool> globes;
  for (const Surface& surface : surfaces_) {
    globes.push_back(std::holds_alternative<LatLong>(surface) || std::holds_alternative<Sphere>(surface));
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (points_[i].hit) lies[i] = lie_of(points_[i], globes[i % count]);
  }
  const auto need_more = [&](std::size_t at, std::size_t next, Step step) {
    if (are_different(points(at), points(next))) return true;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t a = at * count + k, b = next * count + k;
      if (points_[a].hit && are_apart(points_[a], lies[a], points_[b], lies[b], step, globes[k])) return true;
    }
    return false;
  };
  for (int row = -1; row <= height_; ++row) {
    for (int column = -1; column <= width_; ++column) {
      for (const Step step : {Step{1, 0}, Step{-1, 1}, Step{0, 1}, Step{1, 1}}) {
        const int x = column + step.x, y = row + step.y;
        if (x < -1 || x > width_ || y > height_) continue;
        const std::size_t at = place(column, row), next = place(x, y);
        if (need_more(at, next, step)) edges[at] = edges[next] = 1;
      }
    }
  }
  return edges;
}

}  // namespace lensplane
