// SPDX-License-Identifier: Apache-2.0
//
// How much longer a path of straight stretches is than a straight line, as a sum of small terms.
//
// Delays of microseconds have to be known of light that was on its way for thousands of years: the difference
// of two lengths would have no digit left. Let stretch k have the length l_k and the direction d_k. Up to a
// wave front across the present direction d the path is longer than the wave front's way by
//
//   sum of l_k (1 - d_k.d) = sum of l_k |d - d_k|^2/2,
//
// and all that changes where the ray turns by the vector t, from d to d + t, is known from a few sums.
// Round the masses of a plane a ray runs along an arc; its next stretch begins `detour` from where the last
// one ended.

#pragma once

#include "src/basis.h"
#include "src/inlining.h"

namespace lensplane {

/// How a ray goes on behind a plane.
struct Corner {
  Vec3 turn{0};       // its direction there less the one before; without loss of digits
  double arc = 0;     // metres round the masses
  Vec3 detour{0};     // from where the last stretch ends to where the next begins, metres
  double longer = 0;  // the arc, less the detour's part along the new direction, metres
};

struct PathExcess {
  double straight = 0;  // L: sum of l_k, metres
  Vec3 lean{0};         // U: sum of l_k (d - d_k), metres
  double bow = 0;       // sum of l_k |d - d_k|^2/2, metres: what the stretches are longer by
  double spread = 0;    // 2 L bow - |U|^2 = sum over pairs of l_j l_k |d_j - d_k|^2, metres^2
  double arcs = 0;      // sum of the arcs' lengths, metres
  Vec3 detours{0};      // sum of the detours, metres
  double rounding = 0;  // sum of arc - detour.d, metres: what the arcs are longer by

  /// On along the present direction.
  LENSPLANE_ALWAYS_INLINE void go(double way) {
    straight += way;
    spread += 2.0 * bow * way;
  }

  /// Turns the present direction by `turn`.
  LENSPLANE_ALWAYS_INLINE void turn_by(const Vec3& turn) {
    const double half = 0.5 * straight;
    bow += (turn.x * lean.x + turn.y * lean.y + turn.z * lean.z) +
           half * (turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    lean = Vec3(lean.x + turn.x * straight, lean.y + turn.y * straight, lean.z + turn.z * straight);
    rounding -= detours.x * turn.x + detours.y * turn.y + detours.z * turn.z;
  }

  LENSPLANE_ALWAYS_INLINE void go_round(const Corner& corner) {
    turn_by(corner.turn);
    arcs += corner.arc;
    detours = Vec3(detours.x + corner.detour.x, detours.y + corner.detour.y, detours.z + corner.detour.z);
    rounding += corner.longer;
  }
};

/// Metres by which a path is longer than the way of a wave front from its start to its end.
LENSPLANE_ALWAYS_INLINE inline double excess_over_wave_front(const PathExcess& path) {
  return path.bow + path.rounding;
}

/// Metres by which a path that runs on for `way`, and ends `aside` from there, is longer than the straight
/// line between its ends. `aside` is small, and perpendicular to the present direction.
double excess_over_straight_line(const PathExcess& path, double way, const Vec3& aside);

}  // namespace lensplane
