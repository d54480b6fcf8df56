// SPDX-License-Identifier: Apache-2.0
//
// Published figures of lens theory are for small angles: here scenes are scaled until that is what they are,
// and the method `planes` becomes a map from angles seen to angles where light comes from.

#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "src/planes_march.h"
#include "tests/src/deflector_scenes.h"

namespace lensplane {

/// An angle in two dimensions, in units of the scale.
template <class Number>
struct Angle {
  Number x, y;
};

/// A mass at `z` ahead, at sideways position (x, y), all in the units in which the published figures are.
struct PublishedMass {
  double m, x, y, z;
};

/// Lengths across times `scale`, masses times its square: all angles times `scale`.
inline Deflectors scaled_down(const std::vector<PublishedMass>& masses, double scale) {
  std::vector<Lens> lenses;
  for (const auto& [m, x, y, z] : masses) lenses.push_back({m * scale * scale, {x * scale, y * scale, -z}});
  return flat_deflectors(lenses, Law::Weak);
}

/// The ray that is seen at `theta`, with derivatives by it.
inline RayPath<Dual> path_seen_at(const Deflectors& deflectors, double scale, Angle<double> theta) {
  const Dual x(theta.x * scale, scale, 0), y(theta.y * scale, 0, scale);
  const Dual length = sqrt(x * x + y * y + Dual(1.0));
  return march_planes<Dual>(deflectors, DualVec3(x / length, y / length, -1.0 / length));
}

/// Where it crosses the plane at `z`, over scale.
inline Angle<Dual> crossing(const RayPath<Dual>& path, double scale, double z) {
  const RaySegment<Dual>& last = path.segments.back();
  const Dual way = (-z - last.start.z) / last.direction.z;
  return {(last.start.x + last.direction.x * way) / scale, (last.start.y + last.direction.y * way) / scale};
}

/// Where light from infinity comes from, over scale.
inline Angle<Dual> source_angle(const RayPath<Dual>& path, double scale) {
  const DualVec3& last = path.segments.back().direction;
  return {-last.x / last.z / scale, -last.y / last.z / scale};
}

/// The Jacobian's determinant d(a)/d(theta): one over the magnification.
inline double determinant(const Angle<Dual>& a) {
  return a.x.dx * a.y.dy - a.x.dy * a.y.dx;
}

}  // namespace lensplane
