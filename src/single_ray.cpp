// SPDX-License-Identifier: Apache-2.0

#include "src/single_ray.h"

#include <type_traits>
#include <utility>

#include "src/bodies.h"
#include "src/geodesic_batch.h"
#include "src/march.h"
#include "src/planes_march.h"

namespace lensplane {
namespace {

/// Derivatives are as right as files hold them.
constexpr double kDerivativesError = 1e-7;

/// What a ray that meets nothing has: its direction as far as it goes.
template <class Number>
SurfaceHit<Number> no_hit(const GeodesicRay<Number>& ray) {
  SurfaceHit<Number> hit;
  hit.outcome = ray.captured ? Outcome::Captured : ray.unresolved ? Outcome::Unresolved : Outcome::Missed;
  hit.direction = value_of(ray.direction);
  return hit;
}

template <class Number>
SurfaceHit<Number> hit_of_body(const Surface& surface, const Camera& camera, FilmPosition film,
                               const Vector<Number>& first, const BodyHit<Number>& body) {
  SurfaceHit<Number> hit = meet_body_at(surface, camera, film, first, body.point);
  hit.direction = body.direction;
  if (hit.outcome != Outcome::Hit) return hit;
  if constexpr (std::is_same_v<Number, Dual>)
    hit.magnification = magnification_on_body(surface, first, body.point);
  hit.distance = value_of(body.length);
  hit.delay = value_of(body.delay);
  return hit;
}

/// The bodies of the scene as curved rays meet them.
struct CurvedScene {
  std::vector<Ball> balls;
  std::vector<Disc> discs;
};

CurvedScene curved_scene(const Sight& sight) {
  CurvedScene scene;
  for (const Surface& surface : sight.surfaces) {
    if (const auto* sphere = std::get_if<Sphere>(&surface)) {
      scene.balls.push_back({sphere->centre, sphere->radius});
    } else if (const auto disc = disc_of(surface)) {
      scene.discs.push_back(*disc);
    }
  }
  return scene;
}

template <class Number>
RayHits<Number> hits_of(const Sight& sight, FilmPosition film, const Vector<Number>& first,
                        const GeodesicRay<Number>& ray) {
  std::vector<SurfaceHit<Number>> hits;
  auto ball = ray.hits.begin();
  auto disc = ray.disc_hits.begin();
  for (const Surface& surface : sight.surfaces) {
    if (is_body(surface)) {
      const BodyHit<Number>& body = std::holds_alternative<Sphere>(surface) ? *ball++ : *disc++;
      hits.push_back(body.hit ? hit_of_body(surface, sight.camera, film, first, body) : no_hit(ray));
    } else if (is_bent(surface)) {
      hits.push_back(meet_plate(sight.camera, film, first, first));
    } else if (ray.captured || ray.unresolved) {
      hits.push_back(no_hit(ray));
    } else {
      hits.push_back(std::holds_alternative<Plate>(surface)
                         ? meet_plate(sight.camera, film, first, ray.direction)
                         : meet_sky(sight.camera, first, ray.direction));
      hits.back().delay = value_of(ray.delay);
    }
  }
  return {std::move(hits), ray.captured};
}

}  // namespace

template <class Number>
RayPath<Number> path_of_ray(const Camera& camera, const Plan& plan, std::size_t recipe, FilmPosition film) {
  const auto first = direction_from_film<Number>(camera, film);
  if (plan.method == Method::Planes) return march_planes(plan.recipes[recipe], first);
  return march(plan.planes, Vector<Number>(Number(0.0), Number(0.0), Number(0.0)), first);
}

template <class Number>
std::vector<RayHits<Number>> trace_curved_rays(const Sight& sight, const Plan& plan,
                                               std::span<const FilmPosition> films) {
  const CurvedScene scene = curved_scene(sight);
  std::vector<Vector<Number>> first;
  for (const FilmPosition film : films) first.push_back(direction_from_film<Number>(sight.camera, film));
  const Vector<Number> camera(Number(0.0), Number(0.0), Number(0.0));
  const auto rays =
      trace_geodesics<Number>(plan.masses, camera, first, plan.geodesic_tolerance, {scene.balls, scene.discs},
                              {sight.effects.delay, kDerivativesError});
  std::vector<RayHits<Number>> hits;
  for (std::size_t i = 0; i < films.size(); ++i) {
    hits.push_back(hits_of(sight, films[i], first[i], rays[i]));
  }
  return hits;
}

template <class Number>
RayHits<Number> trace_ray(const Sight& sight, const Plan& plan, std::size_t recipe, FilmPosition film) {
  if (plan.method == Method::Geodesic) return trace_curved_rays<Number>(sight, plan, {&film, 1}).front();
  const RayPath<Number> path = path_of_ray<Number>(sight.camera, plan, recipe, film);
  const bool finite = plan.method == Method::Planes && plan.recipes[recipe].finite_distance;
  std::vector<SurfaceHit<Number>> hits;
  for (const Surface& surface : sight.surfaces) {
    hits.push_back(meet(surface, sight.camera, film, path, finite ? &plan.recipes[recipe] : nullptr));
  }
  return {std::move(hits), path.captured};
}

template <class Number>
RayHits<Number> trace_film(const Sight& sight, const Plan& plan, FilmPosition film) {
  const bool planes = plan.method == Method::Planes;
  const std::size_t recipe = planes ? level_at(plan, sight.camera, film) : 0;
  RayHits<Number> ray = trace_ray<Number>(sight, plan, recipe, film);
  if (!planes || !curves_at(plan, sight.camera, film)) return ray;
  RayHits<Number> curved = trace_curved_rays<Number>(sight, plan, {&film, 1}).front();
  for (std::size_t k = 0; k < ray.hits.size(); ++k) {
    if (is_body(sight.surfaces[k])) ray.hits[k] = std::move(curved.hits[k]);
  }
  return ray;
}

template RayPath<double> path_of_ray(const Camera&, const Plan&, std::size_t, FilmPosition);
template RayPath<Dual> path_of_ray(const Camera&, const Plan&, std::size_t, FilmPosition);
template std::vector<RayHits<double>> trace_curved_rays(const Sight&, const Plan&,
                                                        std::span<const FilmPosition>);
template std::vector<RayHits<Dual>> trace_curved_rays(const Sight&, const Plan&,
                                                      std::span<const FilmPosition>);
template RayHits<double> trace_ray(const Sight&, const Plan&, std::size_t, FilmPosition);
template RayHits<Dual> trace_ray(const Sight&, const Plan&, std::size_t, FilmPosition);
template RayHits<double> trace_film(const Sight&, const Plan&, FilmPosition);
template RayHits<Dual> trace_film(const Sight&, const Plan&, FilmPosition);

}  // namespace lensplane
