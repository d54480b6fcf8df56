// SPDX-License-Identifier: Apache-2.0

#include "src/outgoing_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "src/geodesic_batch.h"
#include "src/single_ray.h"

namespace lensplane {
namespace {

RayPath<double> path_by_planes(const Camera& camera, const Plan& plan, FilmPosition film) {
  const std::size_t recipe = plan.method == Method::Planes ? level_at(plan, camera, film) : 0;
  return path_of_ray<double>(camera, plan, recipe, film);
}

OutgoingRay ray_by_planes(const Camera& camera, const Plan& plan, FilmPosition film) {
  const RayPath<double> path = path_by_planes(camera, plan, film);
  if (path.ended()) return {};
  return {path.segments.back().start, path.segments.back().direction, false};
}

/// Of the stretches between two planes the first leads on; the second is the chord round the next masses.
OutgoingRay ray_after(const Camera& camera, const Plan& plan, std::size_t bends, FilmPosition film) {
  if (bends == 0) return {Vec3(0), direction_from_film<double>(camera, film), false};
  const RayPath<double> path = path_by_planes(camera, plan, film);
  for (const RaySegment<double>& segment : path.segments) {
    if (segment.bends == static_cast<int>(bends)) return {segment.start, segment.direction, false};
  }
  return {};
}

/// From the line that a curved ray approaches, past the last mass on its way.
OutgoingRay ray_from_line(const GeodesicRay<double>& ray, std::span<const PointMass> masses) {
  if (ray.captured || ray.unresolved) return {};
  double along = 0.0;
  for (const PointMass& mass : masses)
    along = std::max(along, (mass.position - ray.position).dot(ray.direction));
  return {ray.position + ray.direction * along, ray.direction, false};
}

void trace_curved(const Camera& camera, const Plan& plan, std::span<const PointMass> masses,
                  std::span<const FilmPosition> films, std::span<OutgoingRay> rays) {
  std::vector<std::size_t> seen;
  std::vector<Vec3> first;
  for (std::size_t i = 0; i < films.size(); ++i) {
    if (!sees(camera, films[i])) continue;
    seen.push_back(i);
    first.push_back(direction_from_film<double>(camera, films[i]));
  }
  const auto curved = trace_geodesics<double>(masses, Vec3(0), first, plan.geodesic_tolerance);
  for (std::size_t k = 0; k < seen.size(); ++k) rays[seen[k]] = ray_from_line(curved[k], masses);
}

/// `ray(film)` for each film position that the camera sees.
template <class Ray>
std::vector<OutgoingRay> each_ray(const Camera& camera, std::span<const FilmPosition> films, Ray ray) {
  std::vector<OutgoingRay> rays(films.size());
  tbb::parallel_for(std::size_t{0}, films.size(), [&](std::size_t i) {
    if (sees(camera, films[i])) rays[i] = ray(films[i]);
  });
  return rays;
}

}  // namespace

std::vector<OutgoingRay> outgoing_rays(const Scene& scene, const Plan& plan,
                                       std::span<const FilmPosition> films) {
  const Camera& camera = scene.camera;
  if (plan.method != Method::Geodesic)
    return each_ray(camera, films, [&](FilmPosition film) { return ray_by_planes(camera, plan, film); });
  std::vector<OutgoingRay> rays(films.size());
  const std::size_t pieces = (films.size() + kBatchSize - 1) / kBatchSize;
  tbb::parallel_for(std::size_t{0}, pieces, [&](std::size_t piece) {
    const std::size_t begin = piece * kBatchSize,
                      count = std::min<std::size_t>(kBatchSize, films.size() - begin);
    trace_curved(camera, plan, plan.masses, films.subspan(begin, count),
                 std::span(rays).subspan(begin, count));
  });
  return rays;
}

std::vector<OutgoingRay> rays_after(const Scene& scene, const Plan& plan, std::size_t bends,
                                    std::span<const FilmPosition> films) {
  return each_ray(scene.camera, films,
                  [&](FilmPosition film) { return ray_after(scene.camera, plan, bends, film); });
}

std::vector<double> bend_depths(const Scene& scene, const Plan& plan) {
  std::vector<double> depths;
  if (plan.method == Method::Planes) {
    const Deflectors& all = plan.recipes.back();
    for (std::size_t k = 0; k < all.outward; ++k) depths.push_back(-all.planes[k].centre.z);
    return depths;
  }
  for (const LensPlane& plane : plan.planes) {
    if (plane.distance > 0.0) depths.push_back(plane.distance);
  }
  if (plan.method != Method::Geodesic) return depths;
  for (const Lens& lens : scene.lenses) {
    const double depth = (scene.camera.position - lens.position).dot(scene.camera.axes.z);
    if (lens.m > 0.0 && depth > 0.0) depths.push_back(depth);
  }
  if (depths.empty()) return depths;
  return {*std::min_element(depths.begin(), depths.end())};
}

bool bends_light(const Scene& scene, const Plan& plan) {
  if (std::none_of(scene.lenses.begin(), scene.lenses.end(), [](const Lens& lens) { return lens.m > 0.0; }))
    return false;
  if (plan.method != Method::Planes) return true;
  const std::vector<double> shares = recipe_shares(plan, scene.camera);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i] > 0.0 && (plan.recipes[i].blind || !plan.recipes[i].planes.empty())) return true;
  }
  return false;
}

}  // namespace lensplane
