// SPDX-License-Identifier: Apache-2.0
//
// A batch of rays on their way: the present straight stretch of each, in camera axes.

#pragma once

#include "src/batch.h"
#include "src/projection.h"

namespace lensplane {

/// A batch of rays on their way.
template <class Number>
struct LineBatch {
  VectorLane<Number> start;          // metres, camera axes; its derivatives count across the ray only
  VectorLane<Number> direction;      // unit vectors
  VectorLane<double> first;          // their directions at the camera, where there is no flat screen
  Lane<double> path;                 // metres along the ray from the camera to `start`, when it is asked for
  Lane<double> shapiro;              // metres of Shapiro delay so far, when the arrival time is asked for
  alignas(64) BatchArray irregular;  // 0, or 1 when this kernel does not do for the ray
  alignas(64) BatchArray captured;   // 0 or 1
};

/// Rays from the camera through the film positions (x[i], y[i]). `slope` is slope_per_pixel() of a
/// perspective camera; `path` and `shapiro` are set to zero only where `measured`.
template <class Number>
void start_lines(const Camera& camera, double slope, const BatchArray& x, const BatchArray& y, bool measured,
                 LineBatch<Number>& rays);

}  // namespace lensplane
