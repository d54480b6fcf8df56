// SPDX-License-Identifier: Apache-2.0

#include "src/tracer.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "src/constants.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void clear(SurfaceBatch& surface) {
  std::fill_n(surface.s, kBatchSize, 0.0);
  std::fill_n(surface.t, kBatchSize, 0.0);
  std::fill_n(surface.distance, kBatchSize, 0.0);
  surface.outcome.fill(Outcome::Missed);
}

void set(SurfaceBatch& surface, int i, const SurfaceHit& hit) {
  surface.s[i] = hit.st.s;
  surface.t[i] = hit.st.t;
  surface.distance[i] = hit.distance;
  surface.outcome[i] = hit.outcome;
}

Vec3 point_on_ray(const RayBatch& rays, int i, double distance) {
  return {rays.start_x[i] + rays.dir_x[i] * distance, rays.start_y[i] + rays.dir_y[i] * distance,
          rays.start_z + rays.dir_z[i] * distance};
}

void see_sphere(const Sphere& sphere, const RayBatch& rays, double end_z, SurfaceBatch& surface) {
  const bool beyond = sphere.centre.z + sphere.radius < end_z;
  const bool passed = sphere.centre.z - sphere.radius > rays.start_z;
  if (beyond || passed) return;
  alignas(64) BatchArray entry;
  enter_sphere(sphere.centre, sphere.radius, end_z, rays, entry);
  for (int i = 0; i < kBatchSize; ++i) {
    if (!(entry[i] < kInfinity) || surface.outcome[i] == Outcome::Hit) continue;
    const Vec3 normal = point_on_ray(rays, i, entry[i]) - sphere.centre;
    set(surface, i,
        {Outcome::Hit, st_from_sphere_normal(sphere.axes.local_from_parent(normal)),
         rays.travelled[i] + entry[i]});
  }
}

void see_sky(const Camera& camera, const RayBatch& rays, SurfaceBatch& surface) {
  for (int i = 0; i < kBatchSize; ++i) {
    const Vec3 direction(rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
    set(surface, i,
        {Outcome::Hit, st_from_sky_direction(camera.axes.parent_from_local(direction)), kInfinity});
  }
}

void see_plate(const Camera& camera, const RayBatch& rays, const TraceBatch& batch, SurfaceBatch& surface) {
  alignas(64) BatchArray in_front;
  meet_plate(camera, batch.x, batch.y, rays, surface.s, surface.t, in_front);
  for (int i = 0; i < kBatchSize; ++i) {
    surface.distance[i] = kInfinity;
    surface.outcome[i] = in_front[i] != 0.0 ? Outcome::Hit : Outcome::Behind;
    if (in_front[i] == 0.0) surface.s[i] = surface.t[i] = 0.0;
  }
}

}  // namespace

Tracer::Tracer(const Scene& scene, Plan plan) : camera_(scene.camera), plan_(std::move(plan)) {
  assert(camera_.width > 0 && camera_.height > 0 && camera_.overscan >= 0);
  assert(camera_.fov_rad > 0 && camera_.fov_rad < kPi);
  for (const Surface& surface : scene.surfaces) surfaces_.push_back(camera_from_world(camera_, surface));
}

TraceBatch Tracer::make_batch() const {
  TraceBatch batch;
  batch.surfaces.resize(surfaces_.size());
  return batch;
}

void Tracer::trace(TraceBatch& batch) const {
  assert(batch.surfaces.size() == surfaces_.size());
  std::for_each(batch.surfaces.begin(), batch.surfaces.end(), clear);
  RayBatch rays;
  start_rays(camera_, batch.x, batch.y, rays);
  for (const LensPlane& plane : plan_.planes) {
    if (!(plane.z < 0.0)) continue;
    meet_spheres(rays, plane.z, batch);
    advance_rays(plane.z, rays);
    for (const Source& source : plane.sources) bend_rays(source, rays);
  }
  meet_spheres(rays, -kInfinity, batch);
  meet_infinity(rays, batch);
  for (int i = 0; i < kBatchSize; ++i) {
    if (rays.irregular[i] != 0.0) trace_singly(i, batch);
  }
}

void Tracer::meet_spheres(const RayBatch& rays, double end_z, TraceBatch& batch) const {
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    const auto* sphere = std::get_if<Sphere>(&surfaces_[k]);
    if (sphere) see_sphere(*sphere, rays, end_z, batch.surfaces[k]);
  }
}

void Tracer::meet_infinity(const RayBatch& rays, TraceBatch& batch) const {
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    if (std::holds_alternative<Plate>(surfaces_[k])) see_plate(camera_, rays, batch, batch.surfaces[k]);
    if (std::holds_alternative<LatLong>(surfaces_[k])) see_sky(camera_, rays, batch.surfaces[k]);
  }
}

void Tracer::trace_singly(int i, TraceBatch& batch) const {
  const FilmPosition film{batch.x[i], batch.y[i]};
  const RayPath path = march(plan_.planes, Vec3(0), direction_from_pixel(camera_, film));
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    set(batch.surfaces[k], i, meet(surfaces_[k], camera_, film, path));
  }
}

}  // namespace lensplane
