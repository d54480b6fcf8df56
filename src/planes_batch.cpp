// SPDX-License-Identifier: Apache-2.0

#include "src/planes_batch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "src/bend_strength.h"
#include "src/inlining.h"
#include "src/planes_delay.h"
#include "src/planes_sums.h"

namespace lensplane {
namespace {

using namespace bend;

/// Where the rays pass a single mass.
template <class Number>
struct Approach {
  VectorLane<Number> across;  // from the foot point to the mass
  Lane<Number> along;         // from the start to the foot point
  Lane<Number> measure;       // b^2 with finite distance, otherwise what the law needs of it
};

/// A plane with one mass: the line turns about it. Rays have to stay below `limit_z` in direction.
template <class Number, Bending bending, Reach reach, bool finite, bool path>
LENSPLANE_KERNEL void turn_about(const Deflector& deflector, double limit_z, LineBatch<Number>& rays) {
  constexpr Law law = bending.law;
  Approach<Number> to;
  const Vector<Number> mass = constant<Number>(deflector.position);
  const Limits<reach> limits(deflector, finite);
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vector<Number> direction = rays.direction.get(i);
    const Vector<Number> to_mass = difference(mass, rays.start.get(i));
    const Number along = dot(to_mass, direction);
    const Vector<Number> across = difference(to_mass, scaled(direction, along));
    const Number b2 = dot(across, across);
    to.across.set(i, across);
    if constexpr (finite || path) to.along.set(i, along);
    const bool ahead = finite ? value_of(dot(mass, direction)) >= 0.0 : true;
    mark(i, limits, value_of(direction.z) < limit_z, ahead, value_of(b2), rays);
    if constexpr (finite)
      to.measure.set(i, b2);
    else
      to.measure.set(i, measured<law, reach>(b2));
  }
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Number measure = to.measure.get(i);
    const Vector<Number> across = to.across.get(i);
    const Vector<Number> direction = rays.direction.get(i);
    Strength<Number> strength;
    if constexpr (finite)
      strength = finite_strength<law, reach>(deflector, measure, dot(mass, direction));
    else
      strength = full_strength<law, reach>(deflector.m, measure);
    if constexpr (bending.company) {
      const Number b2 = finite ? measure : squared<law, reach>(measure);
      strength = with_company(deflector.company, b2, strength);
    }
    const Turn<Number> r = turn_within<reach>(strength.per_b * strength.arc);
    const Vector<Number> across_out =
        difference(scaled(across, r.cosine), scaled(direction, strength.arc * r.sine));
    const Vector<Number> out = sum(scaled(direction, r.cosine), scaled(across, strength.per_b * r.sine));
    Vector<Number> start = difference(mass, finite ? scaled(across_out, Number(limits.n)) : across_out);
    if constexpr (finite) {
      const Number along = to.along.get(i);
      start = difference(start, scaled(out, select(value_of(along) < 0.0, along, Number(0.0))));
    }
    if constexpr (path) {
      const double along = value_of(to.along.get(i));
      rays.path.v[i] += (finite && along < 0.0 ? 0.0 : along) + value_of(strength.arc);
    }
    rays.start.set(i, start);
    rays.direction.set(i, out);
  }
}

/// The derivatives of one film coordinate, along a ray.
struct Tangent {
  double p1, p2;  // those of start (moved on to the foot point) and direction along `across`
  double q1, q2;  // and along the normal of the bending plane
};

LENSPLANE_ALWAYS_INLINE inline Tangent tangent_at(const Vec3& start, const Vec3& direction,
                                                  const Vec3& across, const Vec3& normal, double along) {
  const double p2 = dot(across, direction);
  const double q2 = dot(normal, direction);
  return {dot(across, start) + along * p2, p2, dot(normal, start) + along * q2, q2};
}

/// turn_about() for Dual numbers, with the derivatives by hand: a change of the ray within the plane of the
/// bend changes b, and with it alpha; a change across it turns with that plane. (The same as by the rules of
/// Dual numbers, in half the operations.)
template <Bending bending, Reach reach, bool path>
LENSPLANE_KERNEL void turn_about_with_tangents(const Deflector& deflector, double limit_z,
                                               LineBatch<Dual>& rays) {
  constexpr Law law = bending.law;
  VectorLane<double> across_of;
  Lane<double> along_of, per_b2_of, measure_of;
  const Vec3 mass = deflector.position;
  const Limits<reach> limits(deflector, false);
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vec3 d(rays.direction.x.v[i], rays.direction.y.v[i], rays.direction.z.v[i]);
    const Vec3 to_mass(mass.x - rays.start.x.v[i], mass.y - rays.start.y.v[i], mass.z - rays.start.z.v[i]);
    const double along = dot(to_mass, d);
    const Vec3 across = difference(to_mass, scaled(d, along));
    const double b2 = dot(across, across);
    across_of.set(i, across);
    along_of.v[i] = along;
    mark(i, limits, d.z < limit_z, true, b2, rays);
    const double measure = measured<law, reach>(b2);
    measure_of.v[i] = measure;
    per_b2_of.v[i] = law == Law::Weak ? measure : reach == Reach::Far ? measure * measure : 1.0 / b2;
  }
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const double along = along_of.v[i];
    const double per_b2 = per_b2_of.v[i];
    const Vec3 across = across_of.get(i);
    const Vec3 d(rays.direction.x.v[i], rays.direction.y.v[i], rays.direction.z.v[i]);
    const Vec3 normal(d.y * across.z - d.z * across.y, d.z * across.x - d.x * across.z,
                      d.x * across.y - d.y * across.x);
    Strength<double> strength = full_strength<law, reach>(deflector.m, measure_of.v[i]);
    if constexpr (bending.company)
      strength = with_company(deflector.company, squared<law, reach>(measure_of.v[i]), strength);
    const Turn<double> r = turn_within<reach>(strength.per_b * strength.arc);
    const double b_sine = strength.arc * r.sine;  // b sin(alpha)
    const double sine_per_b = strength.per_b * r.sine;
    const Vec3 across_out = difference(scaled(across, r.cosine), scaled(d, b_sine));
    const Vec3 out = sum(scaled(d, r.cosine), scaled(across, sine_per_b));

    const auto carried = [&](const Tangent& t) LENSPLANE_ALWAYS_INLINE {
      const double along_across = t.p1 * per_b2;
      const double along_normal = (r.cosine * t.q1 + b_sine * t.q2) * per_b2;
      return sum(scaled(across_out, along_across), scaled(normal, along_normal));
    };
    const auto turned = [&](const Tangent& t) LENSPLANE_ALWAYS_INLINE {
      const double along_across = (t.p2 + strength.steepness * t.p1) * per_b2;
      const double along_normal = (r.cosine * t.q2 - sine_per_b * t.q1) * per_b2;
      return sum(scaled(across_out, along_across), scaled(normal, along_normal));
    };
    const Tangent x = tangent_at(Vec3(rays.start.x.dx[i], rays.start.y.dx[i], rays.start.z.dx[i]),
                                 Vec3(rays.direction.x.dx[i], rays.direction.y.dx[i], rays.direction.z.dx[i]),
                                 across, normal, along);
    const Tangent y = tangent_at(Vec3(rays.start.x.dy[i], rays.start.y.dy[i], rays.start.z.dy[i]),
                                 Vec3(rays.direction.x.dy[i], rays.direction.y.dy[i], rays.direction.z.dy[i]),
                                 across, normal, along);
    const Vec3 out_x = turned(x), out_y = turned(y);
    const Vec3 start = difference(mass, across_out);
    const Vec3 start_x = carried(x), start_y = carried(y);
    if constexpr (path) rays.path.v[i] += along + strength.arc;
    rays.start.set(i, dual_vector(start, start_x, start_y));
    rays.direction.set(i, dual_vector(out, out_x, out_y));
  }
}

template <class Number>
LENSPLANE_KERNEL void begin_sums(const Vec3& centre, const LineBatch<Number>& rays, SumsBatch<Number>& sums) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) begin_sum(i, centre, rays, sums);
}

template <class Number, Bending bending, Reach reach, bool finite, bool path>
LENSPLANE_KERNEL void add_to_sums(const Deflector& deflector, double limit_z, LineBatch<Number>& rays,
                                  SumsBatch<Number>& sums) {
  const Limits<reach> limits(deflector, finite);
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const auto [ahead, b2] = add_to_sum<Number, bending, reach, finite, path>(i, deflector, rays, sums);
    mark(i, limits, value_of(rays.direction.z.get(i)) < limit_z, ahead, b2, rays);
  }
}

/// A plane with several masses: the line turns by the sum of their bends.
template <class Number, Reach reach, bool finite, bool path>
LENSPLANE_KERNEL void turn_by_sums(const SumsBatch<Number>& sums, LineBatch<Number>& rays) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vector<Number> direction = rays.direction.get(i);
    const Vector<Number> bend = sums.bend.get(i);
    const Number q = dot(bend, bend);
    const Turn<Number> r = turn_within<reach>(q);
    Vector<Number> inward = sum(scaled(sums.kink.get(i), r.sine), scaled(sums.shift.get(i), r.versine));
    if constexpr (finite) inward = sum(inward, sums.outward.get(i));
    const Vector<Number> axis = sum(scaled(bend, r.versine), scaled(direction, r.sine));
    const Vector<Number> rotated = difference(inward, scaled(axis, dot(inward, bend)));
    const Vector<Number> out = sum(scaled(direction, r.cosine), scaled(bend, r.sine));
    Vector<Number> start = difference(sums.reference.get(i), rotated);
    if constexpr (path) start = sum(start, scaled(out, Number(sums.arc.v[i]) * r.sine));  // along the line
    double way = value_of(sums.ahead.get(i));
    if constexpr (finite) {
      const Number back = select(way < 0.0, sums.ahead.get(i), Number(0.0));
      start = difference(start, scaled(out, back));
      way -= value_of(back);
    }
    rays.start.set(i, start);
    rays.direction.set(i, out);
    if constexpr (path) rays.path.v[i] += way + sums.arc.v[i];
    rays.irregular[i] = turn_fits<reach>(value_of(q)) ? rays.irregular[i] : 1.0;
  }
}

template <class Number, Bending bending, Reach reach, bool finite, bool path>
void turn_about_one(const Deflector& deflector, double limit_z, LineBatch<Number>& rays) {
  if constexpr (std::is_same_v<Number, Dual> && !finite) {
    turn_about_with_tangents<bending, reach, path>(deflector, limit_z, rays);
  } else {
    turn_about<Number, bending, reach, finite, path>(deflector, limit_z, rays);
  }
}

template <class Number, Reach reach, bool finite, bool path>
void pass_with(const DeflectorPlane& plane, double limit_z, LineBatch<Number>& rays) {
  if (plane.deflectors.size() == 1) {
    const Deflector& deflector = plane.deflectors.front();
    by_bending(deflector, turn_about_one<Number, kWeak, reach, finite, path>,
               turn_about_one<Number, kSecondOrder, reach, finite, path>,
               turn_about_one<Number, kExact, reach, finite, path>,
               turn_about_one<Number, kInCompany, reach, finite, path>)(deflector, limit_z, rays);
    return;
  }
  SumsBatch<Number> sums;
  begin_sums(plane.centre, rays, sums);
  for (const Deflector& deflector : plane.deflectors) {
    by_bending(deflector, add_to_sums<Number, kWeak, reach, finite, path>,
               add_to_sums<Number, kSecondOrder, reach, finite, path>,
               add_to_sums<Number, kExact, reach, finite, path>,
               add_to_sums<Number, kInCompany, reach, finite, path>)(deflector, limit_z, rays, sums);
  }
  turn_by_sums<Number, reach, finite, path>(sums, rays);
}

template <class Number, Reach reach>
void pass_within(const DeflectorPlane& plane, bool finite, bool path, double limit_z,
                 LineBatch<Number>& rays) {
  if (finite) {
    path ? pass_with<Number, reach, true, true>(plane, limit_z, rays)
         : pass_with<Number, reach, true, false>(plane, limit_z, rays);
  } else {
    path ? pass_with<Number, reach, false, true>(plane, limit_z, rays)
         : pass_with<Number, reach, false, false>(plane, limit_z, rays);
  }
}

/// Light that has turned back on its last plane: it may meet planes again.
template <class Number>
LENSPLANE_KERNEL void mark_turned_back(LineBatch<Number>& rays) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const bool done = (value_of(rays.direction.z.get(i)) < 0.0) | (rays.captured[i] != 0.0);
    rays.irregular[i] = done ? rays.irregular[i] : 1.0;
  }
}

/// Without a screen: light that has turned by more than 45 degrees from its first direction may be on its way
/// back.
template <class Number>
void mark_turned(LineBatch<Number>& rays) {
  for (int i = 0; i < kBatchSize; ++i) {
    const bool onward = dot(rays.first.get(i), value_of(rays.direction.get(i))) > 0.70710678118654757;
    rays.irregular[i] = onward ? rays.irregular[i] : 1.0;
  }
}

}  // namespace

template <class Number>
void pass_plane(const Deflectors& deflectors, std::size_t plane, const PlanesWork& work,
                LineBatch<Number>& rays) {
  const DeflectorPlane& passed = deflectors.planes[plane];
  // With one plane there is nothing that light which turns back could meet.
  const bool alone = deflectors.planes.size() == 1;
  const double limit_z = alone || !deflectors.flat ? std::numeric_limits<double>::infinity() : 0.0;
  if (work.shapiro) add_delay(passed, deflectors.finite_distance, work.reach, rays);
  if (work.reach == Reach::Far) {
    pass_within<Number, Reach::Far>(passed, deflectors.finite_distance, work.path, limit_z, rays);
  } else {
    pass_within<Number, Reach::Near>(passed, deflectors.finite_distance, work.path, limit_z, rays);
  }
  if (alone) return;
  if (!deflectors.flat) {
    mark_turned(rays);
  } else if (plane + 1 == deflectors.outward) {
    mark_turned_back(rays);
  }
}

template void pass_plane(const Deflectors&, std::size_t, const PlanesWork&, LineBatch<double>&);
template void pass_plane(const Deflectors&, std::size_t, const PlanesWork&, LineBatch<Dual>&);

}  // namespace lensplane
