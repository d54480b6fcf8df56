// SPDX-License-Identifier: Apache-2.0
//
// Curved light rays, without lens planes: the reference method `geodesic`.
//
// A ray is integrated through the medium of fermat.h from the camera to infinity, with steps of order 8 as
// long as the tolerance allows. For one mass that is a null geodesic of Schwarzschild, at any distance and
// angle; for several it is right to first order in each mass. Positions are isotropic coordinates relative to
// the camera, along any axes; at a mass's Schwarzschild radius r the distance is rho, r = rho (1 + m/2rho)^2.
// The camera is at rest; angles that it measures are those between coordinate directions.

#pragma once

#include <span>
#include <vector>

#include "src/disc.h"
#include "src/fermat.h"

namespace lensplane {

/// An opaque ball. Rays go on through it: each layer of a picture has its own.
struct Ball {
  Vec3 centre;    // metres
  double radius;  // metres, > 0
};

/// What a ray may meet on its way.
struct Bodies {
  std::span<const Ball> balls = {};
  std::span<const Disc> discs = {};
};

/// Where a ray first enters a ball from outside, or crosses a disc as often as it asks for.
template <class N>
struct BodyHit {
  bool hit = false;
  Vector<N> point{N(0.0)};  // metres
  Vec3 direction{0.0};      // of the ray there, unit vector
  N length = 0.0;           // of the ray up to there, metres
  N delay = 0.0;            // metres of light path: coordinate light time, less |point - start|
};

/// A ray and what it meets. Where it is captured or unresolved there is no asymptote, but there may be hits
/// on the way; what is not there is 0, and its direction is a number without derivatives.
template <class N>
struct GeodesicRay {
  bool captured = false;        // it ends in a mass
  bool unresolved = false;      // it was given up, after kMaxGeodesicSteps or where distances overflow
  Vector<N> direction{N(0.0)};  // unit vector, at infinity; else where it was followed to
  Vector<N> position{N(0.0)};   // of the straight line that the ray approaches: nearest to the start, metres

  /// Coordinate light time from the start, less that of a plane wave with the final direction which passes
  /// the start and meets no masses; each mass's Shapiro delay counts up to as far beyond it as the start is
  /// before it. Metres of light path. For one thin mass, to first order,
  /// delay = 2m ln((z + hypot(z, b)) 2D/b^2), with z = sqrt(D^2 - b^2) the distance from the start to the
  /// foot.
  N delay = 0.0;

  std::vector<BodyHit<N>> hits{};       // one for each ball
  std::vector<BodyHit<N>> disc_hits{};  // one for each disc
};

/// A ray that takes more steps is given up: what becomes of it is not known.
inline constexpr int kMaxGeodesicSteps = 2000;

/// Finer tolerances than this are taken for it.
inline constexpr double kFinestTolerance = 1e-16;

/// What is asked of rays beside where they come from. The less, the longer their steps.
struct RayNeeds {
  bool delay = true;         // right to some 1e-9 of itself; else 0, also at bodies
  double derivatives = 0.0;  // with N = Dual: their relative error, if that may be more than the tolerance
};

/// Delays are right to 1e-9 of themselves: each step to this share of them.
inline constexpr double kDelayShare = 5e-12;

/// The ray from `start` along the unit vector `direction`.
///
/// `tolerance` is the error of the final direction in radians, and of positions per distance from the nearest
/// mass; with N = Dual also the relative error of their derivatives. Near capture, or behind several masses,
/// errors made early grow as the rays themselves spread.
///
/// Captured at once when it starts on a mass, or on or inside a horizon (S >= 1). Masses of zero change
/// nothing; without masses the ray is straight: bit for bit. All results are finite; where distances overflow
/// (beyond 1e150 m) the ray is unresolved.
template <class N>
GeodesicRay<N> trace_geodesic(std::span<const PointMass> masses, const Vector<N>& start,
                              const Vector<N>& direction, double tolerance, const Bodies& bodies = {},
                              const RayNeeds& needs = {});

}  // namespace lensplane
