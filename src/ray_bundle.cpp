// SPDX-License-Identifier: Apache-2.0

#include "src/ray_bundle.h"

#include <algorithm>
#include <cmath>

namespace lensplane {

template <class Number>
LENSPLANE_KERNEL PointBall ball_of(const VectorLane<Number>& start, const VectorLane<Number>& direction,
                                   const double* way) {
  constexpr int kLast = kBatchSize - 1, kLanes = 8;
  const auto at = [&](int i, const Lane<Number>& from, const Lane<Number>& along) {
    return way ? from.v[i] + way[i] * along.v[i] : from.v[i];
  };
  const double x = (at(0, start.x, direction.x) + at(kLast, start.x, direction.x)) / 2;
  const double y = (at(0, start.y, direction.y) + at(kLast, start.y, direction.y)) / 2;
  const double z = (at(0, start.z, direction.z) + at(kLast, start.z, direction.z)) / 2;
  double farthest2[kLanes] = {};
  for (int first = 0; first < kBatchSize; first += kLanes) {
    for (int n = 0; n < kLanes; ++n) {
      const double dx = at(first + n, start.x, direction.x) - x, dy = at(first + n, start.y, direction.y) - y,
                   dz = at(first + n, start.z, direction.z) - z;
      const double distance2 = dx * dx + dy * dy + dz * dz;
      farthest2[n] = distance2 > farthest2[n] ? distance2 : farthest2[n];
    }
  }
  return {{x, y, z}, std::sqrt(*std::max_element(farthest2, farthest2 + kLanes)) * (1.0 + 1e-12)};
}

std::pair<double, double> RayBundle::along(const Vec3& to) const {
  const Vec3 way = to - start.centre;
  const double middle = way.dot(direction.centre);
  const double off = start.radius + (length(way) + start.radius) * direction.radius;
  return {middle - off, middle + off};
}

double RayBundle::distance_from(const Vec3& point, std::pair<double, double> way) const {
  const auto [from, to] = way;
  const double middle = (from + to) / 2, off = (to - from) / 2;
  // Foot points differ by where rays start, how far they go, and whereto.
  return length(point - start.centre - direction.centre * middle) -
         (start.radius + off + std::abs(middle) * direction.radius);
}

template <class Number>
RayBundle bundle_of(const LineBatch<Number>& rays) {
  return {ball_of(rays.start, rays.direction, nullptr), ball_of(rays.direction, rays.direction, nullptr)};
}

template PointBall ball_of(const VectorLane<double>&, const VectorLane<double>&, const double*);
template PointBall ball_of(const VectorLane<Dual>&, const VectorLane<Dual>&, const double*);
template RayBundle bundle_of(const LineBatch<double>&);
template RayBundle bundle_of(const LineBatch<Dual>&);

}  // namespace lensplane
