// SPDX-License-Identifier: Apache-2.0
//
// Where a curved ray crosses a disc.

#pragma once

#include <optional>

#include "src/disc.h"
#include "src/geodesic_entry.h"

namespace lensplane {

inline constexpr int kMaxCrossingSteps = 60;

/// The point of a step between `low` and `high`, t from its beginning, where `value(point)` is zero but for
/// `rounding(point)`; it has different signs there. By Newton's method, halving where that leads outside.
template <class N, class Value, class Slope, class Rounding>
std::optional<RayPoint<N>> find_zero(std::span<const PointMass> masses, const Launch<N>& launch,
                                     const RayPoint<N>& from, double low, double high, bool rises,
                                     Value value, Slope slope, Rounding rounding) {
  double t = 0.5 * (low + high);
  for (int tries = 0; tries < kMaxCrossingSteps; ++tries) {
    const RayPoint<N> point = take_step(masses, launch, from, t).end;
    const double here = value(point);
    if (std::abs(here) <= rounding(point)) return point;
    ((here > 0.0) == rises ? high : low) = t;
    const double newton = t - here / slope(point);
    t = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return std::nullopt;
}

/// A disc as a curved ray sees it.
template <class N>
struct CurvedView {
  const Disc& disc;
  const Launch<N>& launch;

  double height(const RayPoint<N>& at) const { return height_over(disc, value_of(at.x())); }
  double climb(const RayPoint<N>& at) const { return disc.normal.dot(value_of(at.p)); }
  double bend(const RayPoint<N>& at) const { return disc.normal.dot(value_of(at.medium.force)); }
  double rounding(const RayPoint<N>& at) const {
    return disc.tolerance + 1e-15 * (value_of(at.x()) - value_of(launch.start)).length();
  }
};

/// Where a step of length `h` that begins and ends on the same side of a disc turns back behind its plane, in
/// t from its beginning; nothing when it does not.
template <class N>
std::optional<double> find_turn(std::span<const PointMass> masses, const CurvedView<N>& view,
                                const RayPoint<N>& from, double h, const RayStep<N>& step, std::int8_t side) {
  const double nearest = std::min(side * view.height(from), side * view.height(step.end));
  if (!(side * view.climb(from) < 0.0 && side * view.climb(step.end) > 0.0)) return std::nullopt;
  if (nearest > h * h * step.largest_force) return std::nullopt;  // the ray's bulge from its chord
  const auto turn = find_zero(
      masses, view.launch, from, 0.0, h, side > 0, [&](const auto& at) { return view.climb(at); },
      [&](const auto& at) { return view.bend(at); }, [](const auto&) { return 1e-9; });
  if (!turn || side_at(view.disc, view.height(*turn)) == side) return std::nullopt;
  return value_of(turn->t - from.t);
}

/// The point where the step of length `h` meets the disc, to the integrator's accuracy; `passage` goes on to
/// the step's end.
template <class N>
std::optional<RayPoint<N>> find_crossing(std::span<const PointMass> masses, const Launch<N>& launch,
                                         const RayPoint<N>& from, double h, const RayStep<N>& step,
                                         const Disc& disc, DiscPassage& passage) {
  const CurvedView<N> view{disc, launch};
  const auto cross = [&](double low, double high) -> std::optional<RayPoint<N>> {
    passage.side = static_cast<std::int8_t>(-passage.side);
    const auto point = find_zero(
        masses, launch, from, low, high, passage.side > 0, [&](const auto& at) { return view.height(at); },
        [&](const auto& at) { return view.climb(at); }, [&](const auto& at) { return view.rounding(at); });
    return point && count_crossing(disc, value_of(point->x()), passage) ? point : std::nullopt;
  };
  if (side_at(disc, view.height(step.end)) != passage.side) return cross(0.0, h);
  const auto turn = find_turn(masses, view, from, h, step, passage.side);
  if (!turn) return std::nullopt;
  const auto before = cross(0.0, *turn);
  const auto after = cross(*turn, h);
  return before ? before : after;
}

/// The hit of a ray that is all but on the disc at `point`; as hit_at() of a ball.
template <class N>
BodyHit<N> hit_at(const Launch<N>& launch, const RayPoint<N>& point, const Disc& disc) {
  const Vector<N> normal(N(disc.normal.x), N(disc.normal.y), N(disc.normal.z));
  return hit_beyond(launch, point, -height_over(disc, point.x()) * reciprocal(normal.dot(point.p)));
}

}  // namespace lensplane
