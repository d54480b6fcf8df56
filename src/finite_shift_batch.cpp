// SPDX-License-Identifier: Apache-2.0

#include "src/finite_shift_batch.h"

#include "src/bodies.h"
#include "src/finite_shift.h"
#include "src/mass_shift.h"

namespace lensplane {
namespace {

template <class Number>
LENSPLANE_KERNEL void ways_to_ball(const Sphere& sphere, const VectorLane<Number>& start,
                                   const VectorLane<Number>& direction, const Ends& ends,
                                   Lane<Number>& ways) {
#pragma GCC ivdep  // the arrays are all different ones
  for (int i = 0; i < kBatchSize; ++i) {
    ways.set(i, way_to_ball(sphere, start.get(i), direction.get(i), ends.at[i]));
  }
}

/// Adds the shifts by one mass at the starts of stretches, and `ways` further on.
template <class Number, Bent bent>
LENSPLANE_KERNEL void add_shifts(const Deflector& deflector, const VectorLane<Number>& start,
                                 const VectorLane<Number>& direction, const Lane<Number>& ways,
                                 VectorLane<Number>& at_start, VectorLane<Number>& at_way) {
#pragma GCC ivdep
  for (int i = 0; i < kBatchSize; ++i) {
    const Vector<Number> s = start.get(i), d = direction.get(i);
    at_start.set(i, at_start.get(i) + shift_by_mass(deflector, bent, s, d, Number(0.0)));
    at_way.set(i, at_way.get(i) + shift_by_mass(deflector, bent, s, d, ways.get(i)));
  }
}

}  // namespace

template <class Number>
void shift_to_ball(const Deflectors& deflectors, const Sphere& sphere, const Ends& ends, int bends,
                   VectorLane<Number>& start, VectorLane<Number>& direction) {
  Lane<Number> ways;
  ways_to_ball(sphere, start, direction, ends, ways);
  VectorLane<Number> at_start{}, at_way{};
  for (std::size_t k = 0; k < deflectors.outward; ++k) {
    const Bent bent = bent_by_plane(static_cast<int>(k), bends);
    const auto add = bent == Bent::NotYet    ? add_shifts<Number, Bent::NotYet>
                     : bent == Bent::JustNow ? add_shifts<Number, Bent::JustNow>
                                             : add_shifts<Number, Bent::Before>;
    for (const Deflector& deflector : deflectors.planes[k].deflectors) {
      add(deflector, start, direction, ways, at_start, at_way);
    }
  }
  for (int i = 0; i < kBatchSize; ++i) {
    const Vector<Number> from = start.get(i), along = direction.get(i);
    const Number way = ways.get(i);
    const Vector<Number> shifted = from + at_start.get(i);
    start.set(i, shifted);
    if (!(value_of(way) > 0.0)) continue;
    const Vector<Number> point = from + along * way + at_way.get(i);
    direction.set(i, straight_between(shifted, point, RaySegment<Number>{from, along, way, bends}).direction);
  }
}

template void shift_to_ball(const Deflectors&, const Sphere&, const Ends&, int, VectorLane<double>&,
                            VectorLane<double>&);
template void shift_to_ball(const Deflectors&, const Sphere&, const Ends&, int, VectorLane<Dual>&,
                            VectorLane<Dual>&);

}  // namespace lensplane
