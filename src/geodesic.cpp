// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic.h"

#include <algorithm>

#include "src/geodesic_entry.h"
#include "src/geodesic_flight.h"

namespace lensplane {
namespace {

/// A ray in empty space.
template <class N>
GeodesicRay<N> straight_ray(const Vector<N>& start, const Vector<N>& direction, std::span<const Ball> balls) {
  GeodesicRay<N> ray{.direction = direction, .position = start};
  ray.hits.resize(balls.size());
  const Launch<N> launch{start, direction, 0.0};
  for (std::size_t i = 0; i < balls.size(); ++i) {
    RayPoint<N> point = first_point({}, launch);
    const StraightApproach approach = straight_approach(value_of(point.x), value_of(point.p), balls[i]);
    if (!is_outside(balls[i], value_of(start)) || !approach.meets || approach.t < 0.0) continue;
    point.t = approach.t;
    point.x += times(direction, N(approach.t));
    ray.hits[i] = hit_at(launch, point, balls[i]);
  }
  return ray;
}

}  // namespace

template <class N>
GeodesicRay<N> trace_geodesic(std::span<const PointMass> masses, const Vector<N>& start,
                              const Vector<N>& direction, double tolerance, std::span<const Ball> balls) {
  if (masses.empty()) return straight_ray(start, direction, balls);
  if (std::ranges::any_of(masses, [](const PointMass& mass) { return !(mass.m > 0.0); })) {
    return trace_geodesic<N>(without_zeros(masses), start, direction, tolerance, balls);
  }
  GeodesicFlight<N> flight({masses, balls, std::max(kFinestTolerance, tolerance)}, start, direction);
  while (flight.flies()) {
    flight.go_on(take_step(masses, flight.launch(), flight.at(), flight.step_length()));
  }
  return flight.ray();
}

template GeodesicRay<double> trace_geodesic(std::span<const PointMass>, const Vec3&, const Vec3&, double,
                                            std::span<const Ball>);
template GeodesicRay<Dual> trace_geodesic(std::span<const PointMass>, const DualVec3&, const DualVec3&,
                                          double, std::span<const Ball>);

}  // namespace lensplane
