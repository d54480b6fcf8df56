// SPDX-License-Identifier: Apache-2.0

#include "src/finite_shift.h"

#include <algorithm>

namespace lensplane {
namespace {

template <class Number>
Vector<Number> constant(const Vec3& v) {
  return {Number(v.x), Number(v.y), Number(v.z)};
}

/// The shift by one mass, which the light has passed or not.
template <class Number>
Vector<Number> shift_by(const Deflector& deflector, bool passed, const RaySegment<Number>& stretch,
                        double way) {
  const Vector<Number> mass = constant<Number>(deflector.position);
  const Vector<Number> to_mass = mass - stretch.start;
  const Number along = to_mass.dot(stretch.direction);
  const Vector<Number> across = to_mass - stretch.direction * along;
  const Number b2 = across.dot(across);
  if (value_of(b2) == 0.0) return constant<Number>(Vec3(0));
  const Number beyond = way - along;
  const Number z = select((value_of(beyond) > 0.0) == passed, beyond, Number(0.0));
  const Number r = sqrt(z * z + b2);
  if (passed) return across * (2.0 * deflector.m / (r + z));
  const Number z_camera = mass.dot(stretch.direction);
  const Number r_camera = sqrt(z_camera * z_camera + b2);
  return across * ((2.0 * deflector.m) * (r + (z * z_camera - b2) / r_camera) / b2);
}

}  // namespace

template <class Number>
Vector<Number> finite_shift(const Deflectors& deflectors, const RaySegment<Number>& stretch, double way) {
  Vector<Number> shift = constant<Number>(Vec3(0));
  for (std::size_t k = 0; k < deflectors.outward; ++k) {
    const bool passed = static_cast<int>(k) < stretch.bends;
    for (const Deflector& deflector : deflectors.planes[k].deflectors) {
      shift += shift_by(deflector, passed, stretch, way);
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
                           const Vec3& point) {
  const double along = (point - value_of(stretch.start)).dot(value_of(stretch.direction));
  const double way = std::min(along, value_of(stretch.length));
  RaySegment<Number> result = stretch;
  result.start += finite_shift(deflectors, stretch, 0.0);
  if (!(way > 0.0)) return result;
  const Vector<Number> nearest =
      stretch.start + stretch.direction * Number(way) + finite_shift(deflectors, stretch, way);
  result.direction = straight_between(result.start, nearest, stretch).direction;
  return result;
}

template <class Number>
RaySegment<Number> chord_between(const Deflectors& deflectors, const RaySegment<Number>& in,
                                 const RaySegment<Number>& out) {
  const Vector<Number> corner =
      in.start + in.direction * in.length + finite_shift(deflectors, in, value_of(in.length));
  return straight_between(corner, out.start + finite_shift(deflectors, out, 0.0), in);
}

template Vec3 finite_shift(const Deflectors&, const RaySegment<double>&, double);
template DualVec3 finite_shift(const Deflectors&, const RaySegment<Dual>&, double);
template RaySegment<double> straight_between(const Vec3&, const Vec3&, const RaySegment<double>&);
template RaySegment<Dual> straight_between(const DualVec3&, const DualVec3&, const RaySegment<Dual>&);
template RaySegment<double> shifted(const Deflectors&, const RaySegment<double>&, const Vec3&);
template RaySegment<Dual> shifted(const Deflectors&, const RaySegment<Dual>&, const Vec3&);
template RaySegment<double> chord_between(const Deflectors&, const RaySegment<double>&,
                                          const RaySegment<double>&);
template RaySegment<Dual> chord_between(const Deflectors&, const RaySegment<Dual>&, const RaySegment<Dual>&);

}  // namespace lensplane
