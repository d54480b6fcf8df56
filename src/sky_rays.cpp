// SPDX-License-Identifier: Apache-2.0

#include "src/sky_rays.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/constants.h"

namespace lensplane {
namespace {

Scene sky_scene(const Camera& camera) {
  Scene scene;
  scene.camera = camera;
  scene.surfaces = {LatLong{}};
  return scene;
}

Plan sky_plan(Plan plan) {
  plan.effects = {.jacobian = true, .magnification = true};
  const std::vector<std::uint8_t>& levels = plan.tiles.level;
  if (!levels.empty()) plan.recipes = {plan.recipes[*std::max_element(levels.begin(), levels.end())]};
  plan.tiles.level.clear();
  return plan;
}

std::vector<Vec3> masses_of(const Plan& plan) {
  std::vector<Vec3> masses;
  for (const LensPlane& plane : plan.planes) {
    for (const Source& source : plane.sources) masses.push_back(source.position);
  }
  for (const Deflectors& recipe : plan.recipes) {
    for (const DeflectorPlane& plane : recipe.planes) {
      for (const Deflector& deflector : plane.deflectors) masses.push_back(deflector.position);
    }
  }
  return masses;
}

/// From (s, t) of a lat-long sky and their derivatives to directions.
SkyRay sky_ray(const SurfaceBatch& sky, int i) {
  SkyRay ray;
  ray.seen = sky.outcome[static_cast<std::size_t>(i)] == Outcome::Hit;
  if (!ray.seen) return ray;
  const double longitude = (sky.s[i] - 0.5) * 2.0 * kPi, latitude = (sky.t[i] - 0.5) * kPi;
  const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
  const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
  const Vec3 east(cos_lon, 0.0, sin_lon), north(-sin_lon * sin_lat, cos_lat, cos_lon * sin_lat);
  const PassBatch& passes = *sky.passes;
  ray.direction = {sin_lon * cos_lat, sin_lat, -cos_lon * cos_lat};
  ray.by_x = east * (2.0 * kPi * cos_lat * passes.ds_dx[i]) + north * (kPi * passes.dt_dx[i]);
  ray.by_y = east * (2.0 * kPi * cos_lat * passes.ds_dy[i]) + north * (kPi * passes.dt_dy[i]);
  ray.magnification = passes.magnification[i];
  return ray;
}

}  // namespace

SkyRays::SkyRays(const Tracer& tracer)
    : tracer_(sky_scene(tracer.camera()), sky_plan(tracer.plan())), masses_(masses_of(tracer_.plan())) {}

std::vector<SkyRay> SkyRays::trace(std::span<const FilmPosition> films) const {
  std::vector<SkyRay> rays;
  rays.reserve(films.size());
  TraceBatch batch = tracer_.make_batch();
  for (std::size_t first = 0; first < films.size(); first += kBatchSize) {
    const std::size_t count = std::min<std::size_t>(kBatchSize, films.size() - first);
    for (std::size_t i = 0; i < kBatchSize; ++i) {
      const FilmPosition film = films[first + std::min(i, count - 1)];
      batch.x[i] = film.x, batch.y[i] = film.y;
    }
    tracer_.trace(batch);
    for (std::size_t i = 0; i < count; ++i) {
      rays.push_back(sky_ray(batch.surfaces.front(), static_cast<int>(i)));
      rays.back().film = films[first + i];
    }
  }
  return rays;
}

}  // namespace lensplane
