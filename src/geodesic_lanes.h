// SPDX-License-Identifier: Apache-2.0
//
// Steps of several curved rays side by side: take_step() of geodesic_step.h, as plain loops over lanes.

#pragma once

#include "src/geodesic_step.h"

namespace lensplane {

/// Enough to fill the widest vector registers twice; few where lanes go one after the other.
#ifdef LENSPLANE_SANITIZE
inline constexpr int kLanes = 2;
#else
inline constexpr int kLanes = 16;
#endif

/// A number for each lane.
template <class N>
struct LaneNumbers;

template <>
struct LaneNumbers<double> {
  alignas(64) double v[kLanes]{};

  double get(int lane) const { return v[lane]; }
  void set(int lane, double a) { v[lane] = a; }
};

template <>
struct LaneNumbers<Dual> {
  alignas(64) double v[kLanes]{}, dx[kLanes]{}, dy[kLanes]{};

  Dual get(int lane) const { return {v[lane], dx[lane], dy[lane]}; }
  void set(int lane, const Dual& a) { v[lane] = a.v, dx[lane] = a.dx, dy[lane] = a.dy; }
};

template <class N>
struct LaneVectors {
  LaneNumbers<N> x, y, z;

  Vector<N> get(int lane) const { return {x.get(lane), y.get(lane), z.get(lane)}; }
  void set(int lane, const Vector<N>& a) { x.set(lane, a.x), y.set(lane, a.y), z.set(lane, a.z); }
};

template <class N>
struct LanePlaces {
  LaneVectors<double> anchor;
  LaneVectors<N> offset;

  Place<N> get(int lane) const { return {anchor.get(lane), offset.get(lane)}; }
  void set(int lane, const Place<N>& a) { anchor.set(lane, a.anchor), offset.set(lane, a.offset); }
};

template <class N>
struct LaneMedia {
  LaneVectors<N> force;
  LaneNumbers<N> excess;
  LaneNumbers<double> sum, closeness2;

  Medium<N> get(int lane) const {
    return {force.get(lane), excess.get(lane), sum.get(lane), closeness2.get(lane)};
  }
  void set(int lane, const Medium<N>& a) {
    force.set(lane, a.force), excess.set(lane, a.excess), sum.set(lane, a.sum),
        closeness2.set(lane, a.closeness2);
  }
};

template <class N>
struct LanePoints {
  LaneNumbers<N> t;
  LaneVectors<N> xi, pi;
  LaneNumbers<N> length, time;
  LanePlaces<N> place;
  LaneVectors<N> p;
  LaneMedia<N> medium;

  RayPoint<N> get(int lane) const {
    return {t.get(lane),    xi.get(lane),    pi.get(lane), length.get(lane),
            time.get(lane), place.get(lane), p.get(lane),  medium.get(lane)};
  }
  void set(int lane, const RayPoint<N>& a) {
    t.set(lane, a.t), xi.set(lane, a.xi), pi.set(lane, a.pi);
    length.set(lane, a.length), time.set(lane, a.time);
    place.set(lane, a.place), p.set(lane, a.p), medium.set(lane, a.medium);
  }
};

template <class N>
struct LaneLaunches {
  LaneVectors<N> start, direction;
  LaneNumbers<N> excess;

  Launch<N> get(int lane) const { return {start.get(lane), direction.get(lane), excess.get(lane)}; }
  void set(int lane, const Launch<N>& a) {
    start.set(lane, a.start), direction.set(lane, a.direction), excess.set(lane, a.excess);
  }
};

/// A step of every lane.
template <class N>
struct LaneSteps {
  LaneLaunches<N> launch;                                        // in
  LanePoints<N> from;                                            // in
  LaneNumbers<double> h;                                         // in: length of the step
  LanePoints<N> end;                                             // out
  LaneNumbers<double> error_root, derivatives_root, time_error;  // out
  LaneNumbers<double> largest_force, largest_sum;                // out

  RayStep<N> get(int lane) const {
    return {end.get(lane),        error_root.get(lane),    derivatives_root.get(lane),
            time_error.get(lane), largest_force.get(lane), largest_sum.get(lane)};
  }
};

void take_steps(std::span<const PointMass> masses, LaneSteps<double>& steps);
void take_steps(std::span<const PointMass> masses, LaneSteps<Dual>& steps);

}  // namespace lensplane
