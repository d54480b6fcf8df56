// SPDX-License-Identifier: Apache-2.0
//
// Which rays of a batch may meet a sphere on a stretch of their way, before anything costly is done for them:
// most rays are far from it on most stretches.
//
// Light runs beside its straight stretches (finite_shift.h), by a mass m at most by 2 m F, z and b being as
// there:
//
//   before the mass  F = 1 + 2 (max(z, 0) + max(-z - z_c, 0))/b
//   beyond it        F = 1 + 2 max(-z, 0)/b
//
// (the shift before it grows with z, by at most 2 (2 m)/b a metre, from 0 at z = -z_c to less than 2 m at 0).

#pragma once

#include "src/deflectors.h"
#include "src/surfaces_batch.h"

namespace lensplane {

/// What bounds the stretches of a batch.
template <class Number>
struct Stretches {
  const LineBatch<Number>& rays;
  const Ends& ends;
  int bends;                 // planes that have bent the rays so far
  const Deflectors* finite;  // null when light runs along the stretches themselves
};

/// `near[i]` is 1 where the light of ray i may meet the sphere on its stretch, 0 where it surely does not.
template <class Number>
void find_near(const Stretches<Number>& stretches, const Sphere& sphere, BatchArray& near);

/// The same for the chords from the ends of stretches to the starts of those that follow: adds those that may
/// meet the sphere to `near`.
template <class Number>
void add_near_chords(const Stretches<Number>& before, const LineBatch<Number>& after, const Sphere& sphere,
                     BatchArray& near);

}  // namespace lensplane
