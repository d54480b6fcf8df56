// SPDX-License-Identifier: Apache-2.0

#include "src/probe.h"

#include <algorithm>

#include "src/constants.h"
#include "src/single_ray.h"

namespace lensplane {
namespace {

ProbedSurface probed(const SurfaceHit<Dual>& hit) {
  return {hit.outcome,       {hit.st.s.v, hit.st.t.v}, hit.st.s.dx, hit.st.s.dy, hit.st.t.dx, hit.st.t.dy,
          hit.magnification, hit.delay / kLightSpeed,  hit.distance};
}

void add_crossings(const RayPath<double>& path, Probe& result) {
  for (const Passage<double>& p : path.passages) {
    result.crossings.push_back({p.lens, p.path, p.b / p.m, p.alpha});
  }
}

}  // namespace

Probe probe(const Scene& scene, const Plan& plan, FilmPosition film) {
  const Camera& camera = scene.camera;
  Probe result;
  result.film = film;
  result.seen = sees(camera, film);
  if (!result.seen) {
    for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
      result.surfaces.push_back({Outcome::Unseen, {0, 0}, 0, 0, 0, 0, 0, 0, 0});
    }
    return result;
  }
  // A sky behind everything tells the last direction by any method.
  std::vector<Surface> surfaces;
  for (const Surface& surface : scene.surfaces) surfaces.push_back(camera_from_world(camera, surface));
  surfaces.push_back(LatLong{});
  const Sight sight{camera, surfaces, plan.effects};
  result.recipe = plan.method == Method::Planes ? level_at(plan, camera, film) : 0;
  result.curved = plan.method == Method::Geodesic || curves_at(plan, camera, film);
  result.chords_px = chords_px_at(plan, camera, film);
  const auto hits = trace_film<Dual>(sight, plan, film).hits;
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) result.surfaces.push_back(probed(hits[k]));
  const SurfaceHit<Dual>& sky = hits.back();
  result.captured = sky.outcome == Outcome::Captured;
  result.unresolved = sky.outcome == Outcome::Unresolved;
  result.first = camera.axes.parent_from_local(direction_from_film<double>(camera, film));
  result.last = camera.axes.parent_from_local(sky.direction);
  if (plan.method != Method::Geodesic) {
    add_crossings(path_of_ray<double>(camera, plan, result.recipe, film), result);
  }
  return result;
}

}  // namespace lensplane
