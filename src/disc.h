// SPDX-License-Identifier: Apache-2.0
//
// Discs: what rings and cards are to a ray. A disc is flat, light goes through it, and the same ray may meet
// it more than once.
//
// Whether a ray goes through the plane of a disc is decided by the side on which it stands at the end of each
// of its stretches. The side is kept from one stretch to the next, so that where they join no crossing is
// lost and none is counted twice.

#pragma once

#include <cstdint>
#include <optional>

#include "src/deflectors.h"
#include "src/ray_path.h"
#include "src/scene.h"

namespace lensplane {

struct Disc {
  Vec3 centre;       // metres, camera axes
  Vec3 normal;       // unit vector, towards the camera's side
  double inner;      // metres from the centre
  double outer;      // metres from the centre
  int crossing;      // which of a ray's crossings is met, from 0
  double tolerance;  // metres; nearer to the plane a ray has reached it
};

/// A ray that is nearer to the plane of a disc than this share of a ring's outer radius or of a card's
/// distance has reached it: what stands exactly on a lens plane is met before its masses bend.
inline constexpr double kDiscTolerance = 1e-9;

/// A card is this many times as large as it is far away: larger than any plate's picture.
inline constexpr double kCardSize = 1e15;

/// The disc of a ring or card (in camera axes); nothing for other surfaces.
std::optional<Disc> disc_of(const Surface& surface);

/// Metres from the plane of the disc; positive on the camera's side.
template <class Number>
Number height_over(const Disc& disc, const Vector<Number>& point);

/// Does a point of the disc's plane lie on the disc?
bool lies_on(const Disc& disc, const Vec3& point);

/// Metres from a point to the nearest point of the disc.
double gap_to(const Disc& disc, const Vec3& point);

/// How far a ray has come through a disc.
struct DiscPassage {
  std::int8_t side = 0;        // 1 on the camera's side, -1 behind, 0 not on its way yet
  std::uint8_t crossings = 0;  // of the disc, not only of its plane
};

/// The side on which a ray begins: one that begins in the plane stands on the side towards which it runs.
std::int8_t first_side(const Disc& disc, const Vec3& start, const Vec3& direction);

/// The side of a point at this height over the plane.
std::int8_t side_at(const Disc& disc, double height);

/// Counts a crossing of the plane at `point`. True when it is the one that is met.
bool count_crossing(const Disc& disc, const Vec3& point, DiscPassage& passage);

/// Follows a ray along its next stretch. Nothing when it does not meet the disc there. `finite`: the masses
/// when their finite distances count and the stretch is not a chord, otherwise null; see finite_shift.h.
template <class Number>
std::optional<StretchHit<Number>> meet_disc(const Disc& disc, const RaySegment<Number>& stretch,
                                            const Deflectors* finite, DiscPassage& passage);

}  // namespace lensplane
