// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic_flight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "src/geodesic_crossing.h"
#include "src/geodesic_entry.h"
#include "src/geodesic_leap.h"

namespace lensplane {
namespace {

/// Steps reach no farther than this share of the way to the nearest mass, so that none is overlooked.
constexpr double kFirstStep = 0.5, kLongestStep = 0.9;

/// S to which rays that fall in are followed for the sake of a body inside a photon sphere: r = 2.005 m.
constexpr double kDeepestBody = 0.9;

/// The length of a step follows the distance from the nearest mass, inward in proportion, outward by no more
/// than kReceding, and what the error of the step before asks for, between these factors.
constexpr double kReceding = 1.2, kSlowest = 0.2, kFastest = 6.0, kCaution = 0.9;

/// Leaps are worth it from this many times the way to the nearest mass; where the first mass ahead is too far
/// away for one leap, shorter ones are tried, each so many times longer than that way.
constexpr double kShortestLeap = 0.5;
constexpr double kShorterLeaps[] = {256.0, 16.0, 4.0};

/// A mass counts as passed where it lies ahead by less than this share of its distance.
constexpr double kJustPassed = 1e-3;

/// From this S on no leap is tried.
constexpr double kThickMedium = 1e-3;

/// Times by leaps are of first order: so far from a mass, over m and the logarithm of its delay, they are
/// right to 3e-10 of it.
constexpr double kThinForTimes = 1.3e10;

/// Logarithms of delays are no larger than this, as far as errors are concerned.
constexpr double kLongestLogarithm = 100.0;

/// A mass straight behind, to less than this angle.
constexpr double kHeadOn = 1e-8;

/// The cube root, the same on every machine, to a few per cent.
double rough_cube_root(double a) {
  int exponent = 0;
  const double part = std::frexp(a, &exponent);
  const int third = exponent / 3, rest = exponent - 3 * third;
  const double b = std::ldexp(part, rest);  // 1/8 to 4
  double root = 0.5 + 0.3 * b;
  for (int i = 0; i < 3; ++i) root = (2.0 * root + b / (root * root)) / 3.0;
  return std::ldexp(root, third);
}

/// Metres that rays lie apart per radian of their directions.
double spread(const Launch<double>&, const RayPoint<double>&) {
  return 0.0;
}
double spread(const Launch<Dual>& launch, const RayPoint<Dual>& at) {
  const auto spread_of = [&](auto by) {
    const double angle = largest(by(launch.momentum())) + largest(by(at.p));
    return angle > 0.0 ? largest(by(at.place.offset)) / angle : 0.0;
  };
  return std::max(spread_of([](const DualVec3& a) { return derivative_by_x(a); }),
                  spread_of([](const DualVec3& a) { return derivative_by_y(a); }));
}

bool is_finite(double a) {
  return std::isfinite(a);
}
bool is_finite(const Dual& a) {
  return std::isfinite(a.v) && std::isfinite(a.dx) && std::isfinite(a.dy);
}
template <class N>
bool is_finite(const Vector<N>& a) {
  return is_finite(a.x) && is_finite(a.y) && is_finite(a.z);
}

/// May a ray at `q`, from the centre of a ball, along `d` that is bent by no more than `bend` come as near to
/// it as its surface?
bool may_come_near(const Ball& ball, const Vec3& q, const Vec3& d, double bend) {
  const double ahead = -q.dot(d);
  return ahead > 0.0 && (q + d * ahead).length() <= ball.radius + 2.0 * bend * ahead;
}

}  // namespace

template <class N>
GeodesicFlight<N>::GeodesicFlight(const GeodesicScene& scene, const Vector<N>& start,
                                  const Vector<N>& direction)
    : scene_(scene),
      tolerance_(scene.tolerance),
      derivatives_tolerance_(std::max(scene.tolerance, scene.needs.derivatives)),
      launch_{start, direction, 0.0} {
  ray_.hits.resize(scene.bodies.balls.size());
  ray_.disc_hits.resize(scene.bodies.discs.size());
  for (const Disc& disc : scene.bodies.discs)
    passages_.push_back({first_side(disc, value_of(start), value_of(direction))});
  launch_.excess = medium_at(scene.masses, place_at(start)).excess;
  at_ = first_point(scene.masses, launch_);
  if (scene.needs.delay) tighten_for_delay();
  tolerance_root_ = eighth_root(tolerance_);
  derivatives_root_ = eighth_root(derivatives_tolerance_);
  h_ = kFirstStep / (std::sqrt(at_.medium.closeness2) * value_of(1.0 + launch_.excess));
  at_.medium.sum < 1.0 ? go_far() : end_captured();
}

/// Sets what the steps may be off by for the delay's sake, from the delay of the straight line. A ray that
/// is off by an angle is off by b times that in time.
template <class N>
void GeodesicFlight<N>::tighten_for_delay() {
  const Vec3 d = value_of(at_.p).normalized();
  double mass_sum = 0.0, delay = 0.0, angle = 0.0;
  for (const PointMass& mass : scene_.masses) {
    const Vec3 r = at_.from(mass.position);
    const double z = r.dot(d), distance = r.length(), b = (r - d * z).length();
    const double ratio = z < 0.0 ? (distance - z) * 2.0 * distance / (b * b) : 2.0;
    const double logarithm = std::clamp(std::log(ratio), 1.0, kLongestLogarithm);
    mass_sum += 2.0 * mass.m;
    delay += 2.0 * mass.m * logarithm;
    angle += std::min(1.0, 2.0 * mass.m * (1.0 - z / distance) / b) * logarithm;
  }
  tolerance_ = std::min(tolerance_, kDelayShare * angle);
  time_tolerance_ = kDelayShare * delay;
  thin_for_times_ = kThinForTimes * (mass_sum / delay);
}

template <class N>
bool GeodesicFlight<N>::hides_body(const PointMass& mass) const {
  if (at_.medium.sum > kDeepestBody) return false;
  const auto& [balls, discs] = scene_.bodies;
  const double photon = kPhotonSphere * mass.m;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double gap = (balls[i].centre - mass.position).length() - balls[i].radius;
    if (!ray_.hits[i].hit && gap < photon) return true;
  }
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (!ray_.disc_hits[i].hit && gap_to(discs[i], mass.position) < photon) return true;
  }
  return false;
}

template <class N>
typename GeodesicFlight<N>::Heading GeodesicFlight<N>::heading() const {
  const Vec3 p = value_of(at_.p);
  Heading heading = Heading::Away;
  for (const PointMass& mass : scene_.masses) {
    const Vec3 r = at_.from(mass.position);
    if (r.dot(p) > 0.0) continue;
    const double photon = kPhotonSphere * mass.m;
    if (r.dot(r) < photon * photon && !hides_body(mass)) return Heading::Captured;
    heading = Heading::Towards;
  }
  return heading;
}

template <class N>
bool GeodesicFlight<N>::may_meet_bodies(double bend) const {
  const Vec3 d = value_of(at_.p).normalized();
  const auto& [balls, discs] = scene_.bodies;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 q = at_.from(balls[i].centre);
    if (!ray_.hits[i].hit && is_outside(balls[i], q) && may_come_near(balls[i], q, d, bend)) return true;
  }
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& disc = discs[i];
    if (ray_.disc_hits[i].hit || passages_[i].side * disc.normal.dot(d) > 2.0 * bend) continue;
    const Ball round{disc.centre, disc.outer};
    const Vec3 q = at_.from(disc.centre);
    if (!is_outside(round, q) || may_come_near(round, q, d, bend)) return true;
  }
  return false;
}

template <class N>
bool GeodesicFlight<N>::may_meet_bodies_within(double way, double bend) const {
  const Vec3 d = value_of(at_.p).normalized();
  const double beside = 2.0 * bend * way;
  const auto& [balls, discs] = scene_.bodies;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Vec3 q = at_.from(balls[i].centre);
    const Vec3 nearest = q + d * std::clamp(-q.dot(d), 0.0, way);
    if (!ray_.hits[i].hit && is_outside(balls[i], q) && nearest.length() <= balls[i].radius + beside)
      return true;
  }
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& disc = discs[i];
    const double begin = passages_[i].side * height_over(disc, value_of(at_.x()));
    const double end = begin + passages_[i].side * disc.normal.dot(d) * way;
    if (!ray_.disc_hits[i].hit && !(std::min(begin, end) > beside + disc.tolerance)) return true;
  }
  return false;
}

/// The way to where the medium of the first mass ahead is no longer thin, or to its closest approach; 0 where
/// it is not thin.
template <class N>
double GeodesicFlight<N>::longest_leap() const {
  if (at_.medium.sum > kThickMedium) return 0.0;
  const Vec3 d = value_of(at_.p).normalized();
  const double apart = spread(launch_, at_);
  double way = std::numeric_limits<double>::infinity();
  for (const PointMass& mass : scene_.masses) {
    const Vec3 r = at_.from(mass.position);
    const double z = r.dot(d), distance = r.length();
    const double b = (r - d * z).length();
    double thin = mass.m * std::max(rough_cube_root(kLeapError * b / (mass.m * tolerance_)), thin_for_times_);
    if constexpr (std::is_same_v<N, Dual>) {
      const double all_apart = (apart + distance) / mass.m;
      thin = std::max(thin, mass.m * rough_cube_root(kLeapError * all_apart / derivatives_tolerance_));
    }
    if (!(distance > thin)) return 0.0;
    if (!(z < -kJustPassed * distance)) continue;
    way = std::min(way, b > thin ? -z : -z - std::sqrt(thin * thin - b * b));
  }
  return way;
}

/// Goes on by a leap. False when none would do.
template <class N>
bool GeodesicFlight<N>::leap() {
  const double longest = longest_leap(), nearest = 1.0 / std::sqrt(at_.medium.closeness2);
  const bool measured = scene_.needs.delay || !ray_.hits.empty() || !ray_.disc_hits.empty();
  const auto go = [&](double way) {
    const double apart = std::is_same_v<N, Dual> ? spread(launch_, at_) + way : 0.0;
    const Leap<N> leap = leap_from(scene_.masses, launch_, at_, way, apart, measured);
    if (!(leap.error < tolerance_ && leap.derivatives_error < derivatives_tolerance_)) return false;
    if (may_meet_bodies_within(way, leap.bend)) return false;
    at_ = leap.end;
    h_ = kFirstStep / (std::sqrt(at_.medium.closeness2) * value_of(1.0 + at_.medium.excess));
    return true;
  };
  if (!(longest > kShortestLeap * nearest)) return false;
  if (std::isfinite(longest) && go(longest)) return true;
  for (const double times : kShorterLeaps) {
    if (times * nearest < longest && go(times * nearest)) return true;
  }
  return false;
}

/// Goes on as far as leaps lead, to the end if there is nothing else on the way.
template <class N>
void GeodesicFlight<N>::go_far() {
  while (flies_) {
    const Heading heading = this->heading();
    if (heading == Heading::Captured) return end_captured();
    if (heading == Heading::Away && is_far()) return arrive();
    if (!leap()) return;
    if (++steps_ == kMaxGeodesicSteps) return give_up();
  }
}

template <class N>
bool GeodesicFlight<N>::is_far() const {
  const Vec3 d = value_of(at_.p).normalized();
  double bend = 0.0, slope = 0.0;  // of what is to come, and its derivative by x
  for (const PointMass& mass : scene_.masses) {
    const Vec3 r = at_.from(mass.position);
    const double distance = r.length(), z = r.dot(d);
    const double per_metre = 2.0 * mass.m / (distance * (distance + z));
    bend += per_metre * (r - d * z).length();
    slope += per_metre;
  }
  // What the first order leaves out is S times as large.
  const double share = 2.0 * at_.medium.sum;
  return share * bend < tolerance_ && share * slope * spread(launch_, at_) < derivatives_tolerance_ &&
         !may_meet_bodies(bend);
}

template <class N>
Outlook<N> GeodesicFlight<N>::outlook(const Vector<N>& direction) const {
  using std::log, std::sqrt;
  Outlook<N> outlook;
  for (const PointMass& mass : scene_.masses) {
    const Vector<N> from = relative_to(mass.position, at_.place);
    const Vector<N> before = relative_to(mass.position, launch_.start);
    const N z = from.dot(direction), r = sqrt(from.dot(from));
    const Vector<N> b = from - times(direction, z);
    const N share = (2.0 * mass.m) * reciprocal(r + z);
    outlook.bend -= times(b, share * reciprocal(r));  // 2m/b (1 - z/r)
    outlook.shift += times(b, share);                 // what it bends, summed up along the way
    outlook.delay += (2.0 * mass.m) * log(2.0 * sqrt(before.dot(before)) * reciprocal(r + z));
  }
  // Second order: n = 1 + 4S + 7S^2. Along the way of one mass int (r/r')^2 dz' = r^2 (angle to go)/b.
  const double sum = at_.medium.sum;
  const Vec3 d = value_of(direction);
  for (const PointMass& mass : scene_.masses) {
    const Vec3 from = at_.from(mass.position);
    const double z = from.dot(d), b = (from - d * z).length(), r2 = z * z + b * b;
    const double reach = b > kHeadOn * z ? r2 * std::atan2(b, z) / b : r2 / z;
    outlook.delay += N(7.0 * sum * (0.5 * mass.m / std::sqrt(r2)) * reach);
  }
  return outlook;
}

template <class N>
void GeodesicFlight<N>::arrive() {
  using std::sqrt;
  flies_ = false;
  // Everything that differs little from what it was at the start is summed up as that difference.
  const N inverse = reciprocal(1.0 + at_.medium.excess);
  const Vector<N> turned =
      times(at_.pi + times(launch_.direction, launch_.excess - at_.medium.excess), inverse);
  const Vector<N> tangent = times(at_.p, inverse);
  const Outlook<N> rest = outlook(tangent);
  const Vector<N> bent = tangent + rest.bend;
  const N size = sqrt(bent.dot(bent));
  ray_.direction = times(bent, reciprocal(size));
  const Vector<N> far = at_.x() + rest.shift - launch_.start;
  ray_.position = launch_.start + (far - times(ray_.direction, far.dot(ray_.direction)));
  if (scene_.needs.delay) {
    const N longer = (2.0 * tangent.dot(rest.bend) + rest.bend.dot(rest.bend)) * reciprocal(1.0 + size);
    const Vector<N> turn = turned + times(rest.bend - times(tangent, longer), reciprocal(size));
    // t + time - (x - start).direction, where x - start = (1 + excess) t d + xi.
    const N lag = 0.5 * turn.dot(turn);  // 1 - cos
    const N behind = lag - launch_.excess * (1.0 - lag);
    ray_.delay = at_.t * behind + (at_.time - at_.xi.dot(ray_.direction)) + rest.delay;
  }
  if (!(is_finite(ray_.direction) && is_finite(ray_.position) && is_finite(ray_.delay))) give_up();
}

template <class N>
void GeodesicFlight<N>::end_captured() {
  flies_ = false;
  // On a mass and inside a horizon it has not set out: there the medium has no index.
  const Vec3 heading = value_of(at_.p).normalized();
  const Vec3 last = steps_ > 0 && is_finite(heading) ? heading : value_of(launch_.direction);
  ray_ = {.captured = true,
          .direction = {N(last.x), N(last.y), N(last.z)},
          .hits = std::move(ray_.hits),
          .disc_hits = std::move(ray_.disc_hits)};
}

template <class N>
void GeodesicFlight<N>::give_up() {
  end_captured();
  ray_.captured = false;
  ray_.unresolved = true;
}

template <class N>
void GeodesicFlight<N>::meet_bodies(const RayStep<N>& step) {
  const auto& [balls, discs] = scene_.bodies;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (ray_.hits[i].hit || !may_enter(balls[i], at_, h_, step)) continue;
    const auto entry = find_entry(scene_.masses, launch_, at_, h_, step, balls[i]);
    if (entry) ray_.hits[i] = hit_at(launch_, *entry, balls[i]);
  }
  for (std::size_t i = 0; i < discs.size(); ++i) {
    if (ray_.disc_hits[i].hit) continue;
    const auto point = find_crossing(scene_.masses, launch_, at_, h_, step, discs[i], passages_[i]);
    if (point) ray_.disc_hits[i] = hit_at(launch_, *point, discs[i]);
  }
}

template <class N>
void GeodesicFlight<N>::go_on(const RayStep<N>& step) {
  if (++steps_ == kMaxGeodesicSteps) return give_up();
  double excess = std::max(step.error_root / tolerance_root_, step.derivatives_root / derivatives_root_);
  if (scene_.needs.delay) excess = std::max(excess, eighth_root(step.time_error / time_tolerance_));
  const double wish = kCaution / excess;  // a NaN on a mass
  const double factor = wish > kSlowest ? std::min(wish, kFastest) : kSlowest;
  if (!(excess < 1.0 && step.largest_sum < 1.0)) {
    h_ *= std::min(factor, kCaution);
    return;
  }
  meet_bodies(step);
  const Medium<N>& medium = step.end.medium;
  const double nearest = 1.0 / std::sqrt(medium.closeness2);
  const double change = nearest * std::sqrt(at_.medium.closeness2);
  h_ = std::min(h_ * factor * std::min(kReceding, change),
                kLongestStep * nearest / value_of(1.0 + medium.excess));
  at_ = step.end;
  go_far();
}

template class GeodesicFlight<double>;
template class GeodesicFlight<Dual>;

}  // namespace lensplane
