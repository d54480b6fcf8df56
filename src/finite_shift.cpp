// SPDX-License-Identifier: Apache-2.0

#include "src/finite_shift.h"

#include "src/mass_shift.h"

namespace lensplane {
template <class Number>
Vector<Number> finite_shift(const Deflectors& deflectors, const RaySegment<Number>& stretch,
                            const Number& way) {
  Vector<Number> shift = constant<Number>(Vec3(0));
  for (std::size_t k = 0; k < deflectors.outward; ++k) {
    const Bent bent = bent_by_plane(static_cast<int>(k), stretch.bends);
    for (const Deflector& deflector : deflectors.planes[k].deflectors) {
      shift += shift_by_mass(deflector, bent, stretch.start, stretch.direction, way);
    }
  }
  return shift;
}

template <class Number>
RaySegment<Number> straight_between(const Vector<Number>& start, const Vector<Number>& end,
                                    const RaySegment<Number>& along) {
  const Vector<Number> way = end - start;
  const Number size = length(way);
  if (!(value_of(size) > 0.0)) return {start, along.direction, Number(0.0), along.bends};
  return {start, way * reciprocal(size), size, along.bends};
}

template <class Number>
RaySegment<Number> shifted(const Deflectors& deflectors, const RaySegment<Number>& stretch,
                           const Number& way) {
  RaySegment<Number> result = stretch;
  result.start += finite_shift(deflectors, stretch, Number(0.0));
  if (!(value_of(way) > 0.0)) return result;
  const Vector<Number> point =
      stretch.start + stretch.direction * way + finite_shift(deflectors, stretch, way);
  result.direction = straight_between(result.start, point, stretch).direction;
  return result;
}

template <class Number>
RaySegment<Number> chord_between(const Deflectors& deflectors, const RaySegment<Number>& in,
                                 const RaySegment<Number>& out) {
  const Vector<Number> corner = in.start + in.direction * in.length + finite_shift(deflectors, in, in.length);
  return straight_between(corner, out.start + finite_shift(deflectors, out, Number(0.0)), in);
}

template Vec3 finite_shift(const Deflectors&, const RaySegment<double>&, const double&);
template DualVec3 finite_shift(const Deflectors&, const RaySegment<Dual>&, const Dual&);
template RaySegment<double> straight_between(const Vec3&, const Vec3&, const RaySegment<double>&);
template RaySegment<Dual> straight_between(const DualVec3&, const DualVec3&, const RaySegment<Dual>&);
template RaySegment<double> shifted(const Deflectors&, const RaySegment<double>&, const double&);
template RaySegment<Dual> shifted(const Deflectors&, const RaySegment<Dual>&, const Dual&);
template RaySegment<double> chord_between(const Deflectors&, const RaySegment<double>&,
                                          const RaySegment<double>&);
template RaySegment<Dual> chord_between(const Deflectors&, const RaySegment<Dual>&, const RaySegment<Dual>&);

}  // namespace lensplane
