// SPDX-License-Identifier: Apache-2.0
//
// A batch of rays on their way: the present straight stretch of each, in camera axes.

#pragma once

#include "src/batch.h"
#include "src/path_excess.h"
#include "src/projection.h"

namespace lensplane {

/// A PathExcess for each ray.
struct ExcessLane {
  Lane<double> straight, bow, spread, arcs, rounding;
  VectorLane<double> lean, detours;

  LENSPLANE_ALWAYS_INLINE PathExcess get(int i) const {
    return {straight.get(i), lean.get(i),    bow.get(i),     spread.get(i),
            arcs.get(i),     detours.get(i), rounding.get(i)};
  }
  LENSPLANE_ALWAYS_INLINE void set(int i, const PathExcess& a) {
    straight.set(i, a.straight), bow.set(i, a.bow), spread.set(i, a.spread), arcs.set(i, a.arcs);
    rounding.set(i, a.rounding), lean.set(i, a.lean), detours.set(i, a.detours);
  }
};

/// A batch of rays on their way.
template <class Number>
struct LineBatch {
  VectorLane<Number> start;          // metres, camera axes; its derivatives count across the ray only
  VectorLane<Number> direction;      // unit vectors
  VectorLane<double> first;          // their directions at the camera, where there is no flat screen
  Lane<double> path;                 // metres along the ray from the camera to `start`, when it is asked for
  Lane<double> shapiro;              // metres of delay by masses so far, when the arrival time is asked for
  ExcessLane excess;                 // of the path so far, likewise
  alignas(64) BatchArray irregular;  // 0, or 1 when this kernel does not do for the ray
  alignas(64) BatchArray captured;   // 0 or 1
};

/// To that of no path at all.
void clear_excess(ExcessLane& excess);

/// Rays from the camera through the film positions (x[i], y[i]). `slope` is slope_per_pixel() of a
/// perspective camera; what is measured of the path is set to zero only where it is `measured`.
template <class Number>
void start_lines(const Camera& camera, double slope, const BatchArray& x, const BatchArray& y, bool measured,
                 LineBatch<Number>& rays);

}  // namespace lensplane
