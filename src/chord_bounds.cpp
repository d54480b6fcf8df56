// SPDX-License-Identifier: Apache-2.0

#include "src/chord_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/disc.h"
#include "src/plan_bounds.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Metres from a point of a stretch to a body that is filled: convex, so that they have one least value.
double gap_to_filled(const Surface& body, const Vec3& point) {
  if (const auto* sphere = std::get_if<Sphere>(&body)) return length(sphere->centre - point) - sphere->radius;
  Disc disc = *disc_of(body);
  disc.inner = 0.0;
  return gap_to(disc, point);
}

/// From where on a stretch only leads away from a body.
double far_end(const BundleStretch& stretch, const Surface& body, double widening) {
  const auto* ring = std::get_if<Ring>(&body);
  const auto* sphere = std::get_if<Sphere>(&body);
  const Vec3 centre = ring ? ring->centre : sphere->centre;
  const double size = ring ? ring->outer : sphere->radius;
  return std::min(stretch.length, 2.0 * (length(centre - stretch.start) + size) / (1.0 - widening));
}

/// May rays of a stretch, or light that runs `slack` beside them, meet the body?
bool may_meet(const BundleStretch& stretch, double slack, const Surface& body) {
  if (std::holds_alternative<Card>(body)) return true;  // it goes on for ever
  const double widening = stretch.spread * (1.0 + stretch.spread);
  if (!(widening < 0.9)) return true;
  const auto gap = [&](double way) {
    return gap_to_filled(body, stretch.start + stretch.direction * way) -
           (stretch.across + slack + way * widening);
  };
  // A convex function less a straight one is convex: by thirds to its least value.
  double low = 0.0, high = std::max(0.0, far_end(stretch, body, widening));
  constexpr int kThirds = 60;
  for (int i = 0; i < kThirds; ++i) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (gap(a) < gap(b) ? high : low) = gap(a) < gap(b) ? b : a;
  }
  const double rounding = 1e-9 * (length(stretch.start) + high);
  return gap(0.5 * (low + high)) <= rounding;
}

/// Light runs beside its stretches by up to 2 m, and by chords, round masses that it does not pass near, by
/// up to b alpha < 8 m.
double slack_by(const BundleWay& way) {
  double slack = 0.0;
  for (const BundlePass& pass : way.passes) slack += 10.0 * pass.deflector->m;
  return slack;
}

/// The least way from a mass to where light can meet the body: from outside a ball, wherever the mass is.
double way_to_surface(const Surface& body, const Vec3& mass) {
  if (const auto* sphere = std::get_if<Sphere>(&body))
    return std::abs(length(sphere->centre - mass) - sphere->radius);
  return gap_to_body(body, mass);
}

/// The largest b/max(r, b)^2 for b between `least` and `most` and r from `gap` on.
double most_path(double least, double most, double gap) {
  if (gap <= least) return 1.0 / least;
  return gap < most ? 1.0 / gap : most / (gap * gap);
}

/// What one mass misplaces.
struct Misplaced {
  double angle;  // of the direction, radians
  double aside;  // metres
};

/// Infinite where there is no bound.
Misplaced misplaced_by(const BundlePass& pass, const Surface& body) {
  const Deflector& deflector = *pass.deflector;
  const double m = deflector.m, distance = length(deflector.position);
  const double gap = way_to_surface(body, deflector.position);
  const double critical = kCriticalRatio * m / deflector.index;
  const bool near = pass.least_b < kWildRatio * critical;
  if (!(distance >= kChordCamera * m) || (near && !(gap >= kWildRatio * critical)))
    return {kInfinity, kInfinity};
  const double least = std::max(pass.least_b, critical), most = std::max(pass.most_b, least);
  const double share = critical / least, closeness = kChordCamera * m / distance;
  const double of_line = std::holds_alternative<Sphere>(body) ? 2.5 : 0.0;
  const double of_path = 1.25 + of_line + (near ? 0.0 : 3.0 * share * share * share);
  const double of_turn = 3.0 + 12.0 * closeness * closeness * closeness * closeness;
  return {of_turn * m * m * std::min(most, distance) / (distance * distance * distance),
          of_path * m * m * most_path(least, most, gap)};
}

/// How errors at one place grow to where the body is met: in radians at the camera per radian, and per metre.
struct Growth {
  double per_angle;
  double per_metre;

  Growth before(const BundlePlane& plane) const {
    return {per_angle * (1.0 + plane.growth * plane.way) + per_metre * plane.way,
            per_angle * plane.growth + per_metre};
  }
};

}  // namespace

double gap_to_body(const Surface& surface, const Vec3& point) {
  const auto* sphere = std::get_if<Sphere>(&surface);
  if (!sphere) return gap_to(*disc_of(surface), point);
  return std::max(0.0, length(sphere->centre - point) - sphere->radius);
}

bool may_meet(const BundleWay& way, const Surface& body) {
  if (way.lost) return true;
  // On its way in light may wind round the mass.
  const double winds = way.captor ? kWildRatio * kCriticalRatio * way.captor->m : 0.0;
  if (way.captor && gap_to_filled(body, way.captor->position) < winds) return true;
  const double slack = slack_by(way);
  return std::any_of(way.stretches.begin(), way.stretches.end(),
                     [&](const BundleStretch& stretch) { return may_meet(stretch, slack, body); });
}

double misplaced_by_chords(const BundleWay& way, const Surface& body) {
  const double to_camera = gap_to_body(body, Vec3(0));
  if (!(to_camera > 0.0)) return way.passes.empty() ? 0.0 : kInfinity;
  double sum = 0.0;
  const auto add = [&](std::size_t begin, std::size_t end, const Growth& growth) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto [angle, aside] = misplaced_by(way.passes[i], body);
      const double lever = 1.0 + length(way.passes[i].deflector->position) / to_camera;
      sum += growth.per_angle * lever * angle + growth.per_metre * aside;
    }
  };
  const std::size_t known = way.planes.empty() ? 0 : way.planes.back().end;
  add(known, way.passes.size(), {1.0, 1.0 / to_camera});
  Growth growth{way.lost ? kWildGrowth : 1.0, 1.0 / to_camera};
  for (auto plane = way.planes.rbegin(); plane != way.planes.rend(); ++plane) {
    add(plane->begin, plane->end, growth);
    growth = growth.before(*plane);
  }
  return sum;
}

}  // namespace lensplane
