// SPDX-License-Identifier: Apache-2.0
//
// Masses as a refracting medium: Fermat's principle in the static, isotropic metric.
//
// In isotropic coordinates light takes the paths, and the time, that it would take in flat space filled with
// a medium of refractive index
//
//   n = (1 + S)^3 / (1 - S),   S = sum_i m_i / (2 r_i),
//
// exact for one mass (its horizon is at S = 1), right to first order in each mass for several. With the
// parameter t of dx/dt = p, |p| = n, a ray moves like a particle: d^2x/dt^2 = grad(n^2/2). It takes the
// coordinate time dT = n^2 dt for the length dl = n dt.

#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <vector>

#include "src/basis.h"
#include "src/dual.h"
#include "src/place.h"

namespace lensplane {

/// The photon sphere (Schwarzschild radius r = 3 m) in isotropic coordinates, over m: 1 + sqrt(3)/2. Light
/// that moves inward inside it is captured.
inline constexpr double kPhotonSphere = 1.8660254037844386;

/// The horizon (r = 2 m), over m.
inline constexpr double kHorizon = 0.5;

/// A mass by itself: no plane, no law.
struct PointMass {
  double m;       // geometric mass, metres, >= 0
  Vec3 position;  // metres
};

/// Masses of zero left out, so that they change nothing, bit for bit.
inline std::vector<PointMass> without_zeros(std::span<const PointMass> masses) {
  std::vector<PointMass> result;
  std::copy_if(masses.begin(), masses.end(), std::back_inserter(result),
               [](const PointMass& mass) { return mass.m > 0.0; });
  return result;
}

template <class N>
Vector<N> times(const Vector<N>& v, const N& k) {
  return {v.x * k, v.y * k, v.z * k};
}
inline DualVec3 times(const DualVec3& v, double k) {
  return {v.x * k, v.y * k, v.z * k};
}

template <class N>
Vector<N> relative_to(const Vec3& origin, const Vector<N>& x) {
  return x - Vector<N>(origin.x, origin.y, origin.z);
}

/// Sums over the masses at a point.
template <class N>
struct MassSums {
  N sum = 0.0;              // S
  Vector<N> fall{N(0.0)};   // -grad S, per metre
  double closeness2 = 0.0;  // 1/r^2 of the nearest mass
};

template <class N>
void add_mass(const PointMass& mass, const Place<N>& place, MassSums<N>& sums) {
  using std::sqrt;
  const Vector<N> r = relative_to(mass.position, place);
  const N r2 = r.x * r.x + r.y * r.y + r.z * r.z;
  const N inverse2 = reciprocal(r2);  // beside the root, not after it: this is what integration waits for
  const N s = (0.5 * mass.m) * (sqrt(r2) * inverse2);
  sums.sum += s;
  sums.fall += times(r, s * inverse2);
  sums.closeness2 = std::max(sums.closeness2, value_of(inverse2));
}

/// The medium at a point. On and inside horizons, where S >= 1, only S means anything.
template <class N>
struct Medium {
  Vector<N> force{N(0.0)};  // grad(n^2/2), per metre
  N excess = 0.0;           // n - 1, without loss of digits in a thin medium
  double sum = 0.0;         // S
  double closeness2 = 0.0;  // 1/r^2 of the nearest mass, metres^-2
};

template <class N>
Medium<N> medium_of(const MassSums<N>& sums) {
  const N& s = sums.sum;
  const N above = 1.0 + s, below = reciprocal(1.0 - s);
  const N above2 = above * above;
  const N slope = ((2.0 * s - 4.0) * (above2 * above2 * above)) * (below * below * below);  // -n dn/dS
  return {times(sums.fall, slope), s * (4.0 + s * (3.0 + s)) * below, value_of(s), sums.closeness2};
}

template <class N>
Medium<N> medium_at(std::span<const PointMass> masses, const Place<N>& place) {
  MassSums<N> sums;
  for (const PointMass& mass : masses) add_mass(mass, place, sums);
  return medium_of(sums);
}

}  // namespace lensplane
