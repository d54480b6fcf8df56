// SPDX-License-Identifier: Apache-2.0
//
// The path of one ray as the plane methods know it: straight stretches, and the masses that it passes.
//
// A template over its number type: with Dual numbers everything comes with its derivatives by the film
// position.

#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "src/basis.h"
#include "src/deflection.h"
#include "src/dual.h"
#include "src/path_excess.h"

namespace lensplane {

/// A straight stretch of a ray.
template <class Number>
struct RaySegment {
  Vector<Number> start;                                     // metres
  Vector<Number> direction;                                 // unit vector
  Number length = std::numeric_limits<double>::infinity();  // metres
  int bends = 0;                                            // planes that have bent the ray so far
};

/// Where a stretch of a ray meets a body.
template <class Number>
struct StretchHit {
  Vector<Number> point;  // metres
  Vec3 direction;        // of the ray there, unit vector
  double way;            // metres from the stretch's start
};

/// A mass that a ray has passed, as the arrival time needs it. b is a coordinate: with finite distance light
/// is captured up to b = 3 sqrt(3) m/n, n being the index at the camera (deflectors.h).
template <class Number>
struct Passage {
  std::size_t lens;  // its number in the scene
  double m;          // geometric mass, metres
  double distance;   // metres from the camera to the mass
  Number b;          // metres from the mass to the ray's line; see below
  Number alpha;      // angle by which it bent the ray, radians
  Number path;  // metres along the ray from the camera to its closest approach; negative behind the start
  Law law = Law::Weak;  // by which it bent the ray
  double index = 1.0;   // Fermat index of its metric at the camera; 1 without finite distance
  bool finite = false;  // is only as much of the bend counted as lies ahead of the camera?
};

/// A ray from the camera to where it ends or leaves.
template <class Number>
struct RayPath {
  std::vector<RaySegment<Number>> segments;  // never empty; the last one is infinite unless it ended
  std::vector<Number> lengths;               // metres along the ray from the camera to each segment's start
  std::vector<Passage<Number>> passages;
  std::vector<Corner> corners;  // one for each plane that bent it
  int bends = 0;                // planes that bent it
  bool captured = false;        // it ended in a mass
  bool unresolved = false;      // it was given up between the planes, after kMaxCrossings

  bool ended() const { return captured || unresolved; }
};

/// What a path is longer by up to the beginning of its segment number `last`. Each plane adds a corner; by
/// `planes` the chord across it is a segment of its own, on which the ray counts as half turned.
template <class Number>
PathExcess excess_until(const RayPath<Number>& path, std::size_t last) {
  PathExcess excess;
  for (std::size_t i = 0; i <= last; ++i) {
    const RaySegment<Number>& segment = path.segments[i];
    const auto bends = static_cast<std::size_t>(segment.bends);
    const bool chord = i > 0 && segment.bends == path.segments[i - 1].bends;
    if (chord) {
      if (i == last && bends < path.corners.size()) excess.turn_by(path.corners[bends].turn * 0.5);
      continue;
    }
    if (i > 0) excess.go_round(path.corners[bends - 1]);
    if (i < last) excess.go(value_of(segment.length));
  }
  return excess;
}

/// A ray that has crossed planes this often, to and fro, is given up: what becomes of it is not known.
inline constexpr int kMaxCrossings = 1000;

/// A path that begins at `start` along the unit vector `direction`.
template <class Number>
RayPath<Number> path_from(const Vector<Number>& start, const Vector<Number>& direction) {
  return {{{start, direction}}, {Number(0.0)}, {}, {}};
}

}  // namespace lensplane
