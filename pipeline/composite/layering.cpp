// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/layering.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "pipeline/composite/ring_shadow.h"
#include "pipeline/composite/sun_disc.h"

namespace lensplane {
namespace {

double smooth_step(double from, double to, double x) {
  const double share = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return share * share * (3.0 - 2.0 * share);
}

void scale_colour(double by, Rgba& colour) {
  for (std::size_t c = 0; c < 3; ++c) colour[c] *= static_cast<float>(by);
}

/// `over` laid over `under`.
void lay_under(Rgba& over, const Rgba& under) {
  const float clear = 1.0F - over[3];
  for (std::size_t c = 0; c < 4; ++c) over[c] += clear * under[c];
}

/// A sphere by Lambert's law; the night shows as the light fades.
Rgba lit_sphere(const SurfaceLook& look, TextureCoordinates st, const Footprint& footprint) {
  const double cosine = sphere_normal_from_st(st).dot(*look.light);
  Rgba colour = look.texture->filtered(st, footprint);
  scale_colour(lambert_share(look.sun, cosine), colour);
  const double darkness = look.night ? smooth_step(kTwilight, -kTwilight, cosine) : 0.0;
  if (darkness == 0.0) return colour;
  const Rgba night = look.night->filtered(st, footprint);
  for (std::size_t c = 0; c < 3; ++c) colour[c] += static_cast<float>(darkness) * night[c];
  return colour;
}

/// Without the gain.
Rgba shade_plainly(const Surface& surface, const SurfaceLook& look, TextureCoordinates st,
                   const Footprint& footprint) {
  if (look.light && std::holds_alternative<Sphere>(surface)) return lit_sphere(look, st, footprint);
  Rgba colour = look.texture->filtered(st, footprint);
  if (const auto* ring = std::get_if<Ring>(&surface); ring && look.light && look.caster) {
    scale_colour(light_share(*ring, *look.caster, *look.light, look.sun, st, footprint), colour);
  }
  return colour;
}

}  // namespace

std::vector<std::size_t> order_at_infinity(const std::vector<Surface>& surfaces) {
  std::vector<std::size_t> order(surfaces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t k) { return std::holds_alternative<LatLong>(surfaces[k]); });
  return order;
}

SeenPoint seen_point(const SurfaceBatch& surface, std::size_t i) {
  if (surface.outcome[i] != Outcome::Hit) return {};
  const PassBatch& p = *surface.passes;
  return {true,
          surface.distance[i],
          {surface.s[i], surface.t[i]},
          {p.ds_dx[i], p.ds_dy[i], p.dt_dx[i], p.dt_dy[i]}};
}

Rgba shade(const Surface& surface, const SurfaceLook& look, TextureCoordinates st,
           const Footprint& footprint) {
  Rgba colour = shade_plainly(surface, look, st, footprint);
  if (look.gain != 1.0F) scale_colour(look.gain, colour);
  return colour;
}

Viewer::Viewer(const std::vector<Surface>& surfaces, const std::vector<SurfaceLook>& looks)
    : surfaces_(surfaces), looks_(looks), order_(order_at_infinity(surfaces)), by_depth_(order_) {
  assert(looks.size() == surfaces.size());
}

/// Equal distances stay as they are. There are few surfaces: insertion sort.
void Viewer::sort_by_depth(std::span<const SeenPoint> points) {
  by_depth_ = order_;
  const auto farther = [&](std::size_t a, std::size_t b) { return points[a].distance > points[b].distance; };
  for (auto k = by_depth_.begin(); k != by_depth_.end(); ++k) {
    std::rotate(std::upper_bound(by_depth_.begin(), k, *k, farther), k, k + 1);
  }
}

Rgba Viewer::see(std::span<const SeenPoint> points, double scale, SampleOffset offset) {
  Rgba colour{0, 0, 0, 0};
  if (order_.size() > 1) sort_by_depth(points);
  veil_ = 0;
  std::optional<float> nearest;
  for (auto k = by_depth_.rbegin(); k != by_depth_.rend() && colour[3] < 1.0F; ++k) {
    if (!points[*k].hit) continue;
    if (nearest && veil_ == 0) veil_ = *nearest;
    Footprint footprint = points[*k].footprint;
    footprint.scale = scale;
    footprint.x = offset.x;
    footprint.y = offset.y;
    lay_under(colour, shade(surfaces_[*k], looks_[*k], points[*k].st, footprint));
    if (!nearest) nearest = colour[3];
  }
  return colour;
}

float Viewer::nearest_alpha(std::span<const SeenPoint> points, double scale) {
  if (order_.size() > 1) sort_by_depth(points);
  for (auto k = by_depth_.rbegin(); k != by_depth_.rend(); ++k) {
    if (!points[*k].hit) continue;
    Footprint footprint = points[*k].footprint;
    footprint.scale = scale;
    return shade(surfaces_[*k], looks_[*k], points[*k].st, footprint)[3];
  }
  return 0;
}

float Viewer::clearness(std::span<const SeenPoint> points) const {
  float clear = 1.0F;
  for (std::size_t k = 0; k < surfaces_.size() && clear > 0.0F; ++k) {
    if (points[k].hit && !std::holds_alternative<LatLong>(surfaces_[k])) {
      clear *= 1.0F - shade(surfaces_[k], looks_[k], points[k].st, points[k].footprint)[3];
    }
  }
  return std::max(clear, 0.0F);
}

}  // namespace lensplane
