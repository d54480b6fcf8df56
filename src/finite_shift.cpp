// SPDX-License-Identifier: Apache-2.0

#include "src/finite_shift.h"

namespace lensplane {
namespace {

template <class Number>
Vector<Number> constant(const Vec3& v) {
  return {Number(v.x), Number(v.y), Number(v.z)};
}

// Integrating d^2y/dz^2 = 2 m b/r^3 from the camera, at -z_camera, to z gives how far a mass pulls the
// light's path out of a straight line: y/(2 m b) = (r + (z z_camera - b^2)/r_camera)/b^2. What is left of
// that when the line has been bent at z = 0 is y/(2 m b) = (r - z)/b^2. Both without cancellation:

template <class Number>
Number shift_before_bend(const Number& z, const Number& z_camera, const Number& b2) {
  const Number r = sqrt(z * z + b2);
  const Number r_camera = sqrt(z_camera * z_camera + b2);
  const Number product = z * z_camera;
  const Number sum = value_of(product) < 0.0 ? (z * z + z_camera * z_camera + b2) / (r * r_camera - product)
                                             : (r * r_camera + product) / b2;
  return (sum - 1.0) / r_camera;
}

template <class Number>
Number shift_after_bend(const Number& z, const Number& b2) {
  const Number r = sqrt(z * z + b2);
  return value_of(z) >= 0.0 ? 1.0 / (r + z) : (r - z) / b2;
}

/// Metres along a stretch to where it enters the ball, or else is nearest to its centre; not before its
/// start.
template <class Number>
Number way_to_ball(const Vector<Number>& start, const Vector<Number>& direction, const Sphere& sphere) {
  const Vector<Number> to_centre = constant<Number>(sphere.centre) - start;
  const Number along = to_centre.dot(direction);
  const Vector<Number> across = to_centre - direction * along;
  const Number half_chord2 = Number(sphere.radius * sphere.radius) - across.dot(across);
  const Number way = value_of(half_chord2) > 0.0 ? along - sqrt(half_chord2) : along;
  return value_of(way) > 0.0 ? way : Number(0.0);
}

}  // namespace

template <class Number>
Vector<Number> finite_shift(const Deflectors& deflectors, std::optional<std::size_t> bent,
                            const Vector<Number>& start, const Vector<Number>& direction,
                            const Sphere& sphere) {
  const Number way = way_to_ball(start, direction, sphere);
  Vector<Number> shift = constant<Number>(Vec3(0));
  for (std::size_t k = 0; k < deflectors.planes.size(); ++k) {
    for (const Deflector& deflector : deflectors.planes[k].deflectors) {
      const Vector<Number> position = constant<Number>(deflector.position);
      const Vector<Number> to_mass = position - start;
      const Number along = to_mass.dot(direction);
      const Vector<Number> across = to_mass - direction * along;
      const Number z = way - along;  // past the closest approach
      const Number z_camera = position.dot(direction);
      const Number b2 = across.dot(across);
      if (value_of(b2) == 0.0) continue;
      const bool behind = bent ? k < *bent : value_of(z) >= 0.0;
      if (!bent && !behind && value_of(z_camera) < 0.0) continue;
      const Number share = behind ? shift_after_bend(z, b2) : shift_before_bend(z, z_camera, b2);
      shift += across * (2.0 * deflector.m * share);
    }
  }
  return shift;
}

template Vec3 finite_shift(const Deflectors&, std::optional<std::size_t>, const Vec3&, const Vec3&,
                           const Sphere&);
template DualVec3 finite_shift(const Deflectors&, std::optional<std::size_t>, const DualVec3&,
                               const DualVec3&, const Sphere&);

}  // namespace lensplane
