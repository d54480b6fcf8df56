// SPDX-License-Identifier: Apache-2.0
//
// Where a curved ray first enters a ball.

#pragma once

#include <optional>

#include "src/geodesic.h"
#include "src/geodesic_step.h"

namespace lensplane {

inline constexpr int kMaxEntrySteps = 40;

/// Where a straight ray along `p` from the point `q`, relative to the ball's centre, enters the ball, or
/// comes nearest to it when it misses: after `t`.
struct StraightApproach {
  double t;
  bool meets;
};

inline StraightApproach straight_approach(const Vec3& q, const Vec3& p, double radius) {
  const double p2 = p.dot(p), along = q.dot(p), outside = q.dot(q) - radius * radius;
  const double root2 = along * along - p2 * outside;
  if (!(root2 >= 0.0)) return {-along / p2, false};
  const double root = std::sqrt(root2);
  return {along < 0.0 ? outside / (root - along) : -(along + root) / p2, true};
}

/// Does a point, relative to the ball's centre, lie outside it?
inline bool is_outside(const Ball& ball, const Vec3& q) {
  return q.dot(q) > ball.radius * ball.radius;
}

/// False when the step of length `h` certainly does not enter the ball.
template <class N>
bool may_enter(const Ball& ball, const RayPoint<N>& from, double h, const RayStep<N>& step) {
  const Vec3 begin = from.from(ball.centre), end = step.end.from(ball.centre);
  if (!is_outside(ball, begin)) return false;
  if (!is_outside(ball, end)) return true;
  if (!(begin.dot(value_of(from.p)) < 0.0)) return false;
  if (!(end.dot(value_of(step.end.p)) > 0.0)) return false;
  const StraightApproach chord = straight_approach(begin, end - begin, ball.radius);
  if (chord.meets) return true;  // its entry may lie outside the ball by rounding
  const Vec3 nearest = begin + (end - begin) * std::clamp(chord.t, 0.0, 1.0);
  return nearest.length() <= ball.radius + h * h * step.largest_force;  // the ray's bulge from its chord
}

/// The point where the step of length `h` first enters the ball, to the integrator's accuracy: again and
/// again a step from its beginning to where the tangent at the last try would enter.
template <class N>
std::optional<RayPoint<N>> find_entry(std::span<const PointMass> masses, const Launch<N>& launch,
                                      const RayPoint<N>& from, double h, const RayStep<N>& step,
                                      const Ball& ball) {
  const bool ends_inside = !is_outside(ball, step.end.from(ball.centre));
  const double begins = from.from(ball.centre).dot(value_of(from.p));
  const double ends = step.end.from(ball.centre).dot(value_of(step.end.p));
  double t = ends_inside ? h : h * begins / (begins - ends);
  for (int tries = 0; tries < kMaxEntrySteps; ++tries) {
    const RayPoint<N> point = take_step(masses, launch, from, t).end;
    const Vec3 p = value_of(point.p);
    const StraightApproach approach = straight_approach(point.from(ball.centre), p, ball.radius);
    const double rounding = 1e-9 * ball.radius + 1e-15 * point.from(value_of(launch.start)).length();
    if (std::abs(approach.t) * p.length() <= rounding) {
      return approach.meets ? std::optional(point) : std::nullopt;
    }
    t = std::clamp(t + approach.t, 0.0, h);
  }
  return std::nullopt;
}

/// The hit of a ray that stands at `point` and meets a body's surface `step` farther on, in t: a last step,
/// so short that it is straight.
template <class N>
BodyHit<N> hit_beyond(const Launch<N>& launch, const RayPoint<N>& point, const N& step) {
  using std::sqrt;
  const N& excess = point.medium.excess;
  const N t = point.t + step;
  const Vector<N> xi = point.xi + times(point.pi, step);

  BodyHit<N> hit;
  hit.hit = true;
  hit.point = position_of(moved(point.place, times(point.p, step)));
  hit.direction = value_of(point.p).normalized();
  hit.length = t + (point.length + excess * step);
  // |hit - start| = |along direction + xi|, less n0 t without loss of digits.
  const Vector<N> way = hit.point - launch.start;
  const N straight = (1.0 + launch.excess) * t;
  const N longer =
      (2.0 * straight * launch.direction.dot(xi) + xi.dot(xi)) * reciprocal(straight + sqrt(way.dot(way)));
  hit.delay = (point.time + excess * (2.0 + excess) * step) - launch.excess * t - longer;
  return hit;
}

/// The hit of a ray that is all but on the ball's surface at `point`. The last step on to the surface is
/// Newton's; taken in N, it carries the derivatives: where they enter later, rays end farther on.
template <class N>
BodyHit<N> hit_at(const Launch<N>& launch, const RayPoint<N>& point, const Ball& ball) {
  const Vector<N> q = relative_to(ball.centre, point.place);
  return hit_beyond(launch, point, (ball.radius * ball.radius - q.dot(q)) * reciprocal(2.0 * q.dot(point.p)));
}

}  // namespace lensplane
