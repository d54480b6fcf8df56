// SPDX-License-Identifier: Apache-2.0
//
// Scenes that several tests trace.

#pragma once

#include "src/constants.h"
#include "src/tracer.h"

namespace lensplane {

inline constexpr double kSeedMassKg = 1.989e31;      // every source of the paper
inline constexpr double kSeedDistance = 1.09e9;      // m, to the Earth
inline constexpr double kSeedEarthRadius = 6.371e6;  // m
inline constexpr double kDegree = kPi / 180.0;

inline double seed_m() {
  return geometric_mass_from_kg(kSeedMassKg);
}

/// The paper's scene with sources at these sideways offsets, at 0.4, 0.5 and 0.6 of the Earth's distance.
inline Scene seed_scene(int resolution, const Vec3& near, const Vec3& middle, const Vec3& far) {
  Scene scene;
  scene.camera.width = scene.camera.height = resolution;
  scene.camera.fov_rad = 3.0 * kDegree;
  double depth = 0.4;
  for (const Vec3& offset : {near, middle, far}) {
    scene.lenses.push_back({seed_m(), offset - Vec3(0, 0, depth * kSeedDistance)});
    depth += 0.1;
  }
  scene.surfaces = {Sphere{{0, 0, -kSeedDistance}, kSeedEarthRadius, {}}};
  return scene;
}

inline Scene seed_fig6(int resolution) {
  const double s = 5.95e6;
  return seed_scene(resolution, {-s, -0.5 * s, 0}, {s, -0.4 * s, 0}, {0.1 * s, 0.9 * s, 0});
}

/// What one film position of the scene sees on its first surface, by the batches.
inline SurfaceHit<double> trace_one(const Scene& scene, FilmPosition film,
                                    Method method = Method::ShinotsukaMakino) {
  const Tracer tracer(scene, plan_trace(scene, method));
  TraceBatch batch = tracer.make_batch();
  for (int i = 0; i < kBatchSize; ++i) batch.x[i] = film.x, batch.y[i] = film.y;
  tracer.trace(batch);
  const SurfaceBatch& surface = batch.surfaces.front();
  SurfaceHit<double> hit;
  hit.outcome = surface.outcome[0];
  hit.st = {surface.s[0], surface.t[0]};
  hit.distance = surface.distance[0];
  return hit;
}

}  // namespace lensplane
