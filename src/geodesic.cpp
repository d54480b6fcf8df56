// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic.h"

#include <algorithm>

#include "src/geodesic_crossing.h"
#include "src/geodesic_entry.h"
#include "src/geodesic_flight.h"

namespace lensplane {
namespace {

/// A ray in empty space.
template <class N>
GeodesicRay<N> straight_ray(const Vector<N>& start, const Vector<N>& direction, const Bodies& bodies) {
  GeodesicRay<N> ray{.direction = direction, .position = start};
  const auto& [balls, discs] = bodies;
  ray.hits.resize(balls.size());
  ray.disc_hits.resize(discs.size());
  const Launch<N> launch{start, direction, 0.0};
  for (std::size_t i = 0; i < balls.size(); ++i) {
    RayPoint<N> point = first_point({}, launch);
    const Vec3 q = point.from(balls[i].centre);
    const StraightApproach approach = straight_approach(q, value_of(point.p), balls[i].radius);
    if (!is_outside(balls[i], q) || !approach.meets || approach.t < 0.0) continue;
    point.t = approach.t;
    point.place = moved(point.place, times(direction, N(approach.t)));
    ray.hits[i] = hit_at(launch, point, balls[i]);
  }
  for (std::size_t i = 0; i < discs.size(); ++i) {
    DiscPassage passage;
    const RaySegment<double> ahead{value_of(start), value_of(direction)};
    const auto crossing = meet_disc(discs[i], ahead, nullptr, passage);
    if (!crossing) continue;
    RayPoint<N> point = first_point({}, launch);
    point.t = crossing->way;
    point.place = moved(point.place, times(direction, N(crossing->way)));
    ray.disc_hits[i] = hit_at(launch, point, discs[i]);
  }
  return ray;
}

}  // namespace

template <class N>
GeodesicRay<N> trace_geodesic(std::span<const PointMass> masses, const Vector<N>& start,
                              const Vector<N>& direction, double tolerance, const Bodies& bodies,
                              const RayNeeds& needs) {
  if (masses.empty()) return straight_ray(start, direction, bodies);
  if (std::ranges::any_of(masses, [](const PointMass& mass) { return !(mass.m > 0.0); })) {
    return trace_geodesic<N>(without_zeros(masses), start, direction, tolerance, bodies, needs);
  }
  GeodesicFlight<N> flight({masses, bodies, std::max(kFinestTolerance, tolerance), needs}, start, direction);
  while (flight.flies()) {
    flight.go_on(take_step(masses, flight.launch(), flight.at(), flight.step_length()));
  }
  return flight.ray();
}

template GeodesicRay<double> trace_geodesic(std::span<const PointMass>, const Vec3&, const Vec3&, double,
                                            const Bodies&, const RayNeeds&);
template GeodesicRay<Dual> trace_geodesic(std::span<const PointMass>, const DualVec3&, const DualVec3&,
                                          double, const Bodies&, const RayNeeds&);

}  // namespace lensplane
