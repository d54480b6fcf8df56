// SPDX-License-Identifier: Apache-2.0

#include "src/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lensplane {
namespace {

/// Where a ray meets a sphere, and its direction there, both in camera axes.
struct Meeting {
  Vec3 point, direction;
};

Meeting meeting(const Camera& camera, const Sphere& sphere, const SurfaceBatch& surface, std::size_t i) {
  const PassBatch& passes = *surface.passes;
  const Vec3 normal = sphere_normal_from_st({surface.s[i], surface.t[i]});
  return {sphere.centre + sphere.axes.parent_from_local(normal) * sphere.radius,
          camera.axes.local_from_parent({passes.dir_x[i], passes.dir_y[i], passes.dir_z[i]})};
}

double radians_apart(const Camera& camera, const Sphere& sphere, const SurfaceBatch& a, const SurfaceBatch& b,
                     std::size_t i) {
  const Meeting one = meeting(camera, sphere, a, i), other = meeting(camera, sphere, b, i);
  return (one.point - other.point).cross(other.direction).length() / one.point.length();
}

double share_of(std::size_t count, std::size_t all) {
  return all == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(all);
}

}  // namespace

double pixels_apart(const Camera& camera, const Surface& surface, const SurfaceBatch& a,
                    const SurfaceBatch& b, std::size_t i) {
  const TextureCoordinates p{a.s[i], a.t[i]}, q{b.s[i], b.t[i]};
  if (const auto* sphere = std::get_if<Sphere>(&surface))
    return radians_apart(camera, *sphere, a, b, i) / pixel_angle(camera);
  if (const auto* ring = std::get_if<Ring>(&surface))
    return angle_between(ring_point_from_st(*ring, p).normalized(),
                         ring_point_from_st(*ring, q).normalized()) /
           pixel_angle(camera);
  if (std::holds_alternative<LatLong>(surface))
    return angle_between(sky_direction_from_st(p), sky_direction_from_st(q)) / pixel_angle(camera);
  return std::hypot((p.s - q.s) * camera.width, (p.t - q.t) * camera.height);
}

RayError error_of_ray(const Tracer& tracer, const TraceBatch& a, const TraceBatch& b, std::size_t i) {
  RayError error;
  for (std::size_t k = 0; k < tracer.surfaces().size(); ++k) {
    const Outcome one = a.surfaces[k].outcome[i], other = b.surfaces[k].outcome[i];
    error.validity_differs |= (one == Outcome::Hit) != (other == Outcome::Hit);
    error.captured_differs |= (one == Outcome::Captured) != (other == Outcome::Captured);
    if (one != Outcome::Hit || other != Outcome::Hit) continue;
    const double px = pixels_apart(tracer.camera(), tracer.surfaces()[k], a.surfaces[k], b.surfaces[k], i);
    error.px = std::isnan(px) ? std::numeric_limits<double>::infinity() : std::max(error.px, px);
    error.compared = true;
  }
  return error;
}

ErrorSummary summary_of(const std::vector<RayError>& errors) {
  ErrorSummary summary;
  std::vector<double> px;
  std::size_t seen = 0, validity = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    validity += errors[i].validity_differs;
    summary.captured_differs += errors[i].captured_differs;
    summary.rays += errors[i].compared || errors[i].validity_differs;
    if (!errors[i].compared) continue;
    px.push_back(errors[i].px);
    seen += errors[i].px > kSeenErrorPx;
    if (errors[i].px > summary.most_px) summary.most_px = errors[i].px, summary.worst = i;
  }
  summary.compared = px.size();
  summary.share_seen = share_of(seen, summary.rays);
  summary.share_validity_differs = share_of(validity, summary.rays);
  if (px.empty()) return summary;
  const auto least_of = [&](double share) {  // the least error that so many rays do not exceed
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(px.size()))) - 1;
    std::nth_element(px.begin(), px.begin() + rank, px.end());
    return px[static_cast<std::size_t>(rank)];
  };
  summary.median_px = least_of(0.5);
  summary.p99_px = least_of(0.99);
  return summary;
}

double ErrorSummary::judged_px() const {
  return compared > 0 && share_validity_differs <= 0.01 ? p99_px : std::numeric_limits<double>::infinity();
}

}  // namespace lensplane
