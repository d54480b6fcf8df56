// SPDX-License-Identifier: Apache-2.0
//
// Where something is, in two parts: what is near keeps the digits of its distance, however far away both are.
//
// A coordinate of 1e20 m ends at 16 km. A ray that passes a star at that distance from the camera has to
// know its way past the star much better than that; a second number holds what the first cannot.

#pragma once

#include "src/basis.h"
#include "src/dual.h"

namespace lensplane {

template <class N>
struct Place {
  Vec3 anchor{0.0};          // metres
  Vector<N> offset{N(0.0)};  // metres from there, with all derivatives
};

template <class N>
LENSPLANE_ALWAYS_INLINE inline Vector<N> sum_of(const Vec3& a, const Vector<N>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

/// From `origin` to a place.
template <class N>
LENSPLANE_ALWAYS_INLINE inline Vector<N> relative_to(const Vec3& origin, const Place<N>& place) {
  return sum_of(Vec3(place.anchor.x - origin.x, place.anchor.y - origin.y, place.anchor.z - origin.z),
                place.offset);
}

/// The place as one vector, rounded.
template <class N>
Vector<N> position_of(const Place<N>& place) {
  return sum_of(place.anchor, place.offset);
}

template <class N>
Place<N> place_at(const Vector<N>& position) {
  const Vec3 anchor = value_of(position);
  return {anchor, sum_of(-anchor, position)};
}

/// The place `way` from here. Its anchor is the nearest vector of numbers to it.
template <class N>
Place<N> moved(const Place<N>& from, const Vector<N>& way) {
  const Vector<N> offset = from.offset + way;
  const Vec3 value = value_of(offset);
  const Vec3 anchor = from.anchor + value;
  // What was lost in that sum (D. Knuth's two-sum); 0 or no number where it overflows.
  const Vec3 added = anchor - from.anchor;
  const Vec3 lost = (from.anchor - (anchor - added)) + (value - added);
  return {anchor, sum_of(lost - value, offset)};
}

}  // namespace lensplane
