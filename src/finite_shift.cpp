// SPDX-License-Identifier: Apache-2.0

#include "src/finite_shift.h"

namespace lensplane {
namespace {

/// Has a mass bent a stretch?
enum class Bent {
  NotYet,
  JustNow,  // by the plane at its start; the mass's own foot point may still lie ahead
  Before,
};

// The formulas of the header over 2 m b, without cancellation.

template <class Number>
Number shift_before(const Number& z, const Number& z_camera, const Number& b2) {
  const Number r = sqrt(z * z + b2);
  const Number r_camera = sqrt(z_camera * z_camera + b2);
  const Number product = z * z_camera;
  const Number sum = value_of(product) < 0.0 ? (z * z + z_camera * z_camera + b2) / (r * r_camera - product)
                                             : (r * r_camera + product) / b2;
  return (sum - 1.0) / r_camera;
}

template <class Number>
Number shift_after(const Number& z, const Number& b2) {
  const Number r = sqrt(z * z + b2);
  return value_of(z) < 0.0 ? (r - z) / b2 : 1.0 / (r + z);
}

/// The shift by one mass. One that the light, having turned back, comes towards again counts as if beside it.
template <class Number>
Vector<Number> shift_by(const Deflector& deflector, Bent bent, const RaySegment<Number>& stretch,
                        const Number& way) {
  const Vector<Number> mass = constant<Number>(deflector.position);
  const Vector<Number> to_mass = mass - stretch.start;
  const Number along = to_mass.dot(stretch.direction);
  const Vector<Number> across = to_mass - stretch.direction * along;
  const Number b2 = across.dot(across);
  if (value_of(b2) == 0.0) return constant<Number>(Vec3(0));
  const Number beyond = way - along;
  const Number z = select(bent == Bent::Before && value_of(beyond) < 0.0, Number(0.0), beyond);
  const Number share =
      bent == Bent::NotYet ? shift_before(z, mass.dot(stretch.direction), b2) : shift_after(z, b2);
  return across * (2.0 * deflector.m * share);
}

}  // namespace

template <class Number>
Vector<Number> finite_shift(const Deflectors& deflectors, const RaySegment<Number>& stretch,
                            const Number& way) {
  Vector<Number> shift = constant<Number>(Vec3(0));
  for (std::size_t k = 0; k < deflectors.outward; ++k) {
    const int plane = static_cast<int>(k);
    const Bent bent = plane >= stretch.bends       ? Bent::NotYet
                      : plane == stretch.bends - 1 ? Bent::JustNow
                                                   : Bent::Before;
    for (const Deflector& deflector : deflectors.planes[k].deflectors) {
      shift += shift_by(deflector, bent, stretch, way);
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
