// SPDX-License-Identifier: Apache-2.0

#include "src/planes_delay.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/bend_strength.h"
#include "src/exact_law.h"
#include "src/planes_sums.h"

namespace lensplane {
namespace {

using namespace bend;

/// Adds the Shapiro delay of a mass, for light from infinity: 2 m ln((z1 + r1) 2 D/b^2).
LENSPLANE_KERNEL void add_shapiro(const Deflector& deflector, LineBatch<double>& rays) {
  const Vec3 mass = deflector.position;
  const double twice_distance = 2.0 * length(mass);
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vec3 d = rays.direction.get(i);
    const Vec3 to_mass = difference(mass, rays.start.get(i));
    const double along = dot(to_mass, d);
    const Vec3 across = difference(to_mass, scaled(d, along));
    const double b2 = dot(across, across);
    const double z1 = rays.path.v[i] + along;
    const double r1 = std::sqrt(z1 * z1 + b2);
    const bool ahead = z1 >= 0.0;
    const double ratio = (ahead ? z1 + r1 : 1.0) * twice_distance / (ahead ? b2 : r1 - z1);
    rays.shapiro.v[i] += 2.0 * deflector.m * log_of_share(1.0 - ratio, ratio);
  }
}

/// Adds what a law bends more than the weak one to the delay of a mass: w(b) of arrival_time.h.
template <Law law, bool finite>
LENSPLANE_KERNEL void add_higher_orders(const Deflector& deflector, LineBatch<double>& rays) {
  constexpr double kSecond = 15.0 * std::numbers::pi / 4.0;
  const Vec3 mass = deflector.position;
  const double m = deflector.m;
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vec3 d = rays.direction.get(i);
    const Vec3 to_mass = difference(mass, rays.start.get(i));
    const double along = dot(to_mass, d);
    const Vec3 across = difference(to_mass, scaled(d, along));
    const double b2 = dot(across, across);
    double nearest2 = b2, share = 1.0;
    if constexpr (finite) {
      const double z1 = rays.path.v[i] + along, r2 = z1 * z1 + b2;
      nearest2 = deflector.index * deflector.index * (z1 >= 0.0 ? b2 : r2);
      const double c = z1 / std::sqrt(r2);
      share = 0.25 * (1.0 + c) * (1.0 + c) * (2.0 - c);
    }
    const double b = std::sqrt(nearest2);
    const double w = law == Law::SecondOrder ? kSecond * m * m / b : exact_excess_beyond(m, b);
    rays.shapiro.v[i] += share * w;
  }
}

/// Adds what a plane makes of the path's length: the corner of planes_march.cpp, of which the kernels that
/// turn the rays keep nothing.
template <Reach reach, bool finite>
LENSPLANE_KERNEL void add_corner(const LineBatch<double>& rays, const SumsBatch<double>& sums,
                                 ExcessLane& excess) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vec3 direction = rays.direction.get(i), bend = sums.bend.get(i);
    const double q = dot(bend, bend), ahead = sums.ahead.get(i), arc = sums.arc.v[i];
    const Turn<double> r = turn_within<reach>(q);
    Vec3 inward = sum(scaled(sums.kink.get(i), r.sine), scaled(sums.shift.get(i), r.versine));
    if constexpr (finite) inward = sum(inward, sums.outward.get(i));
    const Vec3 axis = sum(scaled(bend, r.versine), scaled(direction, r.sine));
    const Vec3 rotated = difference(inward, scaled(axis, dot(inward, bend)));
    const Vec3 out = sum(scaled(direction, r.cosine), scaled(bend, r.sine));
    const Vec3 turn = difference(scaled(bend, r.sine), scaled(direction, q * r.versine));
    const double back = finite && ahead < 0.0 ? ahead : 0.0;
    const Vec3 detour = difference(scaled(out, arc * r.sine), sum(rotated, scaled(turn, back)));
    const double longer = arc * (1.0 - r.sine) + back * (q * r.versine);
    PathExcess path = excess.get(i);
    path.go(ahead - back);
    path.go_round({turn, arc, detour, longer});
    excess.set(i, path);
  }
}

LENSPLANE_KERNEL void begin_sums(const Vec3& centre, const LineBatch<double>& rays, SumsBatch<double>& sums) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) begin_sum(i, centre, rays, sums);
}

template <Bending bending, Reach reach, bool finite>
LENSPLANE_KERNEL void add_to_sums(const Deflector& deflector, const LineBatch<double>& rays,
                                  SumsBatch<double>& sums) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    add_to_sum<double, bending, reach, finite, true>(i, deflector, rays, sums);
  }
}

template <Bending bending, Reach reach, bool finite>
void add_mass(const Deflector& deflector, LineBatch<double>& rays, SumsBatch<double>& sums) {
  add_shapiro(deflector, rays);
  if constexpr (bending.law != Law::Weak) add_higher_orders<bending.law, finite>(deflector, rays);
  add_to_sums<bending, reach, finite>(deflector, rays, sums);
}

template <Reach reach, bool finite>
void add_plane(const DeflectorPlane& plane, LineBatch<double>& rays) {
  SumsBatch<double> sums;
  begin_sums(plane.centre, rays, sums);
  for (const Deflector& deflector : plane.deflectors) {
    by_bending(deflector, add_mass<kWeak, reach, finite>, add_mass<kSecondOrder, reach, finite>,
               add_mass<kExact, reach, finite>, add_mass<kInCompany, reach, finite>)(deflector, rays, sums);
  }
  add_corner<reach, finite>(rays, sums, rays.excess);
}

void add_plane(const DeflectorPlane& plane, bool finite, Reach reach, LineBatch<double>& rays) {
  if (reach == Reach::Far) {
    finite ? add_plane<Reach::Far, true>(plane, rays) : add_plane<Reach::Far, false>(plane, rays);
  } else {
    finite ? add_plane<Reach::Near, true>(plane, rays) : add_plane<Reach::Near, false>(plane, rays);
  }
}

}  // namespace

template <>
void add_delay(const DeflectorPlane& plane, bool finite_distance, Reach reach, LineBatch<double>& rays) {
  add_plane(plane, finite_distance, reach, rays);
}

/// Arrival times come without derivatives.
template <>
void add_delay(const DeflectorPlane& plane, bool finite_distance, Reach reach, LineBatch<Dual>& rays) {
  LineBatch<double> values;
  for (int i = 0; i < kBatchSize; ++i) {
    values.start.set(i, value_of(rays.start.get(i)));
    values.direction.set(i, value_of(rays.direction.get(i)));
  }
  values.path = rays.path, values.shapiro = rays.shapiro, values.excess = rays.excess;
  add_plane(plane, finite_distance, reach, values);
  rays.shapiro = values.shapiro, rays.excess = values.excess;
}

}  // namespace lensplane
