// SPDX-License-Identifier: Apache-2.0
//
// One step along a curved ray, of order 8, and how wrong it is.
//
// What is integrated is how a ray departs from the straight line on which it starts, so that small
// deflections and delays keep their digits however long the way: x = start + p0 t + xi, p = p0 + pi. Where
// the ray is, is kept as a place by itself (place.h), step by step: what it passes is near it, not near the
// start.

#pragma once

#include <array>

#include "src/fermat.h"
#include "src/nystrom.h"

namespace lensplane {

/// How a ray starts.
template <class N>
struct Launch {
  Vector<N> start;      // metres
  Vector<N> direction;  // unit vector
  N excess;             // n - 1 at the start

  Vector<N> momentum() const { return times(direction, 1.0 + excess); }  // p0
};

/// A point of a ray, with all that its next step begins with.
template <class N>
struct RayPoint {
  N t = 0.0;             // metres
  Vector<N> xi{N(0.0)};  // metres
  Vector<N> pi{N(0.0)};
  N length = 0.0;  // of the ray up to here, less t, metres
  N time = 0.0;    // of light up to here, less t, metres
  Place<N> place;  // x
  Vector<N> p;
  Medium<N> medium;  // at x

  Vector<N> x() const { return position_of(place); }                                    // metres, rounded
  Vec3 from(const Vec3& origin) const { return value_of(relative_to(origin, place)); }  // metres
};

template <class N>
RayPoint<N> first_point(std::span<const PointMass> masses, const Launch<N>& launch) {
  RayPoint<N> point;
  point.place = place_at(launch.start);
  point.p = launch.momentum();
  point.medium = medium_at(masses, point.place);
  return point;
}

template <class N>
struct RayStep {
  RayPoint<N> end;
  double error_root;        // error^(1/8), radians
  double derivatives_root;  // the same of the derivatives' relative error
  double time_error;        // metres
  double largest_force;     // of all stages, per metre
  double largest_sum;       // of all stages: S
};

/// Where stage `i` of a step stands, from the anchor of its beginning, given its sum of a_ij f_j.
template <class N>
Vector<N> stage_offset(const Vector<N>& from, const Vector<N>& p, double h, int i, const Vector<N>& bend) {
  return from + (times(p, kNystromNodes[i] * h) + times(bend, h * h));
}

/// What a step adds up over its stages.
template <class N>
struct StageSums {
  Vector<N> shift{N(0.0)}, impulse{N(0.0)}, error_x{N(0.0)}, error_p{N(0.0)};  // forces by the weights
  N length = 0.0, time = 0.0;
  double error_time = 0.0, largest_excess = 0.0;
  double largest_force = 0.0, largest_sum = 0.0;
};

inline double largest(const Vec3& v) {
  return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

template <class N>
void add_stage(int i, const Vector<N>& force, const N& excess, double sum, StageSums<N>& sums) {
  sums.shift += times(force, kNystromMatrix.back()[i]);
  sums.impulse += times(force, kNystromVelocity[i]);
  sums.error_x += times(force, kNystromPositionError[i]);
  sums.error_p += times(force, kNystromVelocityError[i]);
  sums.length += kNystromVelocity[i] * excess;
  sums.time += kNystromVelocity[i] * (excess * (2.0 + excess));
  sums.error_time += kNystromVelocityError[i] * (2.0 * value_of(excess));
  sums.largest_excess = std::max(sums.largest_excess, value_of(excess));
  sums.largest_force = std::max(sums.largest_force, largest(value_of(force)));
  sums.largest_sum = std::max(sums.largest_sum, sum);
}

/// The error of order 8 of a step, from the estimate `error6` of that of order 6 and the whole `bend` of the
/// step: an order that gains the factor q multiplies the error by q each time.
inline double eighth_order(double error6, double bend) {
  return error6 == 0.0 ? 0.0 : error6 * std::sqrt(std::sqrt(error6 / bend));  // a NaN stays one
}

/// The relative error of one derivative of a step, given the same derivative of whatever it depends on.
inline double derivative_error(const Vec3& p0, const Vec3& x, const Vec3& p, const Vec3& impulse,
                               const Vec3& error_x, const Vec3& error_p, double h, double closeness) {
  const double size_p = largest(p0) + largest(p);
  const double size_x = largest(x) * closeness + size_p;  // per distance from the nearest mass
  if (size_p == 0.0) return 0.0;
  const double error6 = h * (largest(error_p) / size_p + h * closeness * largest(error_x) / size_x);
  return eighth_order(error6, h * largest(impulse) / size_p + error6);
}
inline double derivatives_error(const Launch<double>&, const RayPoint<double>&, const StageSums<double>&,
                                double, double) {
  return 0.0;
}
inline double derivatives_error(const Launch<Dual>& launch, const RayPoint<Dual>& from,
                                const StageSums<Dual>& sums, double h, double closeness) {
  const auto error_of = [&](auto by) {
    return derivative_error(by(launch.momentum()), by(from.place.offset), by(from.p), by(sums.impulse),
                            by(sums.error_x), by(sums.error_p), h, closeness);
  };
  return std::max(error_of([](const DualVec3& a) { return derivative_by_x(a); }),
                  error_of([](const DualVec3& a) { return derivative_by_y(a); }));
}

/// error^(1/8), by which a step of order 8 should have been shorter. Roots are the same on every machine;
/// std::pow is not.
inline double eighth_root(double error) {
  return std::sqrt(std::sqrt(std::sqrt(error)));
}

/// The step of length `h` that these sums make, up to the medium at its end.
template <class N>
RayStep<N> step_of(const Launch<N>& launch, const RayPoint<N>& from, double h, const StageSums<N>& sums,
                   const Medium<N>& medium) {
  RayStep<N> step;
  RayPoint<N>& end = step.end;
  end.t = from.t + h;
  end.xi = from.xi + (times(from.pi, h) + times(sums.shift, h * h));
  end.pi = from.pi + times(sums.impulse, h);
  end.length = from.length + h * sums.length;
  end.time = from.time + h * sums.time;
  end.p = launch.momentum() + end.pi;
  end.place = moved(from.place, times(from.p, h) + times(sums.shift, h * h));
  end.medium = medium;
  const double closeness = std::sqrt(std::max(from.medium.closeness2, medium.closeness2));
  const double error6 =
      h * (largest(value_of(sums.error_p)) + h * closeness * largest(value_of(sums.error_x)));
  const double error = eighth_order(error6, h * sums.largest_force);
  step.error_root = eighth_root(error);
  step.derivatives_root = eighth_root(derivatives_error(launch, from, sums, h, closeness));
  step.time_error = eighth_order(h * std::abs(sums.error_time), 2.0 * h * sums.largest_excess);
  step.largest_force = sums.largest_force;
  step.largest_sum = sums.largest_sum;
  return step;
}

/// A step of length `h` in t.
template <class N>
RayStep<N> take_step(std::span<const PointMass> masses, const Launch<N>& launch, const RayPoint<N>& from,
                     double h) {
  std::array<Medium<N>, kNystromStages> stages;
  stages[0] = from.medium;
#pragma GCC unroll 8
  for (int i = 1; i < kNystromStages; ++i) {
    Vector<N> bend(N(0.0));
#pragma GCC unroll 8
    for (int j = 0; j < i; ++j) bend += times(stages[j].force, kNystromMatrix[i][j]);
    const Vector<N> offset = stage_offset(from.place.offset, from.p, h, i, bend);
    stages[i] = medium_at(masses, Place<N>{from.place.anchor, offset});
  }
  StageSums<N> sums;
#pragma GCC unroll 9
  for (int i = 0; i < kNystromStages; ++i) {
    add_stage(i, stages[i].force, stages[i].excess, stages[i].sum, sums);
  }
  return step_of(launch, from, h, sums, stages.back());
}

}  // namespace lensplane
