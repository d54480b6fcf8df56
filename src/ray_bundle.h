// SPDX-License-Identifier: Apache-2.0
//
// A batch of rays all at once: what holds for every one of them is found out with a few numbers.

#pragma once

#include <utility>

#include "src/line_batch.h"

namespace lensplane {

/// A ball that holds one point of every ray of a batch.
struct PointBall {
  Vec3 centre;
  double radius;
};

/// A ball round the points that lie `way[i]` along `direction` from `start`; null: round the starts.
template <class Number>
PointBall ball_of(const VectorLane<Number>& start, const VectorLane<Number>& direction, const double* way);

/// Rays that start in one ball, and whose unit directions end in another.
struct RayBundle {
  PointBall start, direction;

  /// From what to what v . d comes, v pointing from the starts to `to` and d being the directions.
  std::pair<double, double> along(const Vec3& to) const;

  /// At least so far do the lines that the rays lie on pass by a point; negative when that is not known.
  /// `way`: along(point).
  double distance_from(const Vec3& point, std::pair<double, double> way) const;
};

template <class Number>
RayBundle bundle_of(const LineBatch<Number>& rays);

}  // namespace lensplane
