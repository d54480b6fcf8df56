// SPDX-License-Identifier: Apache-2.0
//
// A leap: a long step of a curved ray through thin medium, in closed form, to first order in the masses.
//
// A step of geodesic_step.h is no longer than the way to the nearest mass: to a star that light passes at a
// distance of 1e-9 of its own it takes some fifty. On the straight line past a mass with the impact parameter
// b, from z0 to z1 = z0 + L beyond its closest approach, light is bent towards it, and displaced, by
//
//   2 m b u,  u = int dz/r^3 = [z/r]/b^2,    and    2 m b v,  v = int (z1 - z) dz/r^3,    r = hypot(z, b),
//
// written without cancellation for a mass that lies ahead all the way, or behind. The first order leaves out
// the second, and that the ray runs beside the line; both are estimated.

#pragma once

#include "src/geodesic_step.h"

namespace lensplane {

/// The straight line past one mass.
template <class N>
struct LeapLine {
  N z0, r0, z1, r1, b2;

  bool passes() const { return value_of(z0) < 0.0 && value_of(z1) > 0.0; }  // the closest approach
  bool behind() const { return value_of(z0) >= 0.0; }
  N w0() const { return behind() ? z0 : -z0; }
  N w1() const { return behind() ? z1 : -z1; }
};

/// u, per metre^2.
template <class N>
N bend_share(const LeapLine<N>& a) {
  if (a.passes()) return (a.z1 * reciprocal(a.r1) - a.z0 * reciprocal(a.r0)) * reciprocal(a.b2);
  const N u = reciprocal(a.r1 * (a.r1 + a.w1())) - reciprocal(a.r0 * (a.r0 + a.w0()));
  return a.behind() ? -u : u;
}

/// v, per metre.
template <class N>
N shift_share(const LeapLine<N>& a) {
  const N way = a.z1 - a.z0;
  if (a.passes()) return ((a.r1 - a.r0) - way * a.z0 * reciprocal(a.r0)) * reciprocal(a.b2);
  const N grown = a.behind() ? a.r1 * a.w1() - a.r0 * a.w0() : a.r0 * a.w0() - a.r1 * a.w1();
  return way * grown * reciprocal((a.r0 + a.r1) * a.r0 * (a.r0 * a.r1 + a.w0() * a.w1()));
}

/// int dz/r.
template <class N>
N delay_share(const LeapLine<N>& a) {
  using std::log;
  if (a.passes()) return log((a.r1 + a.z1) * (a.r0 - a.z0) * reciprocal(a.b2));
  const N ratio = (a.r1 + a.w1()) * reciprocal(a.r0 + a.w0());
  return a.behind() ? log(ratio) : -log(ratio);
}

/// What a leap has done.
template <class N>
struct Leap {
  RayPoint<N> end;
  double error = 0.0;              // of the direction, radians
  double derivatives_error = 0.0;  // relative
  double bend = 0.0;               // the sum of what the masses bend, radians
};

/// Sums over the masses.
template <class N>
struct LeapSums {
  Vector<N> bend{N(0.0)}, shift{N(0.0)};
  N gain = 0.0;                                  // of the way along the line, by the force along it, metres
  N shapiro = 0.0;                               // sum of 2 m int dz/r
  double bends = 0.0, slopes = 0.0;              // sum of |bend|; of its derivatives by x, per metre
  double bends_per_r = 0.0, slopes_per_r = 0.0;  // the same over the distance from the mass at the end
  double widening = 0.0;                         // the derivative of the shift by x
};

template <class N>
void add_to_leap(const PointMass& mass, const Place<N>& place, const Vector<N>& along, double way,
                 bool measured, LeapSums<N>& sums) {
  using std::sqrt;
  const Vector<N> r = relative_to(mass.position, place);
  const N z0 = r.dot(along), z1 = z0 + N(way);
  const Vector<N> b = r - times(along, z0);
  const N b2 = b.dot(b);
  const LeapLine<N> line{z0, sqrt(z0 * z0 + b2), z1, sqrt(z1 * z1 + b2), b2};
  const N bend = (2.0 * mass.m) * bend_share(line), shift = (2.0 * mass.m) * shift_share(line);
  sums.bend -= times(b, bend);
  sums.shift -= times(b, shift);
  if (measured) {
    const N delay = delay_share(line);
    sums.gain += (2.0 * mass.m) * (delay - N(way) * reciprocal(line.r0));
    sums.shapiro += (2.0 * mass.m) * delay;
  }
  const double slope = value_of(bend), size = slope * std::sqrt(value_of(b2)), end = value_of(line.r1);
  sums.bends += size, sums.slopes += slope;
  sums.bends_per_r += size / end, sums.slopes_per_r += slope / end;
  sums.widening += value_of(shift);
}

/// The second order over the first is this times S at most: that of the whole bend past one mass is 15 pi/8.
inline constexpr double kLeapSecondOrder = 6.0;

/// Up to the distance r from one mass, b beside it, a leap's error is estimated as at most this times m^2
/// b/r^3.
inline constexpr double kLeapError = 14.0;

/// The leap of `way` metres from a point along its tangent; `spread` as in geodesic_flight.cpp, at its end.
/// Lengths and times only where `measured`.
template <class N>
Leap<N> leap_from(std::span<const PointMass> masses, const Launch<N>& launch, const RayPoint<N>& from,
                  double way, double spread, bool measured) {
  using std::sqrt;
  const N index = 1.0 + from.medium.excess;
  const Vector<N> along = times(from.p, reciprocal(sqrt(from.p.dot(from.p))));
  LeapSums<N> sums;
  for (const PointMass& mass : masses) add_to_leap(mass, from.place, along, way, measured, sums);

  Leap<N> leap;
  RayPoint<N>& end = leap.end;
  const N h = (way - sums.gain) * reciprocal(index);
  const N longer = (way * from.medium.excess + sums.gain) * reciprocal(index);  // way - h
  end.t = from.t + h;
  end.xi = from.xi + times(from.pi, h) + sums.shift + times(along, sums.gain);
  end.length = from.length + longer;
  end.time = from.time + longer + sums.shapiro;
  end.place = moved(from.place, times(along, N(way)) + sums.shift);
  end.medium = medium_at(masses, end.place);
  // Turned by the bend, and as long as the index says there.
  const Vector<N> bent = times(along, index) + sums.bend;
  const N bend2 = sums.bend.dot(sums.bend), size = sqrt(index * index + bend2);
  const N longer_p = (end.medium.excess - from.medium.excess) - bend2 * reciprocal(index + size);
  end.pi = from.pi + sums.bend + times(bent, longer_p * reciprocal(size));
  end.p = launch.momentum() + end.pi;

  const double shift = value_of(sums.shift).length();
  const double relative = kLeapSecondOrder * std::max(from.medium.sum, end.medium.sum) + sums.bends;
  leap.bend = sums.bends;
  leap.error = sums.bends * relative + shift * sums.bends_per_r;
  leap.derivatives_error =
      spread * (sums.slopes * (relative + sums.widening) + 2.0 * shift * sums.slopes_per_r);
  return leap;
}

}  // namespace lensplane
