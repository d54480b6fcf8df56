// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic_flight.h"

#include "src/geodesic_crossing.h"
#include "src/geodesic_entry.h"

namespace lensplane {
namespace {

/// Steps reach no farther than this share of the way to the nearest mass, so that none is overlooked.
constexpr double kFirstStep = 0.5, kLongestStep = 0.9;

/// S to which rays that fall in are followed for the sake of a body inside a photon sphere: r = 2.005 m.
constexpr double kDeepestBody = 0.9;

/// The length of a step follows the distance from the nearest mass, inward in proportion, outward by no more
/// than kReceding, and what the error of the step before asks for, between these factors.
constexpr double kReceding = 1.2, kSlowest = 0.2, kFastest = 6.0, kCaution = 0.9;

/// Metres that rays lie apart per radian of their directions.
double spread(const Launch<double>&, const RayPoint<double>&) {
  return 0.0;
}
double spread(const Launch<Dual>& launch, const RayPoint<Dual>& at) {
  const auto spread_of = [&](auto by) {
    const double angle = largest(by(launch.momentum())) + largest(by(at.p));
    return angle > 0.0 ? largest(by(at.x)) / angle : 0.0;
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

/// May a ray at `x` along `d` that is bent by no more than `bend` come as near to a ball as its surface?
bool may_come_near(const Ball& ball, const Vec3& x, const Vec3& d, double bend) {
  const Vec3 q = x - ball.centre;
  const double ahead = -q.dot(d);
  return ahead > 0.0 && (q + d * ahead).length() <= ball.radius + 2.0 * bend * ahead;
}

}  // namespace

template <class N>
GeodesicFlight<N>::GeodesicFlight(const GeodesicScene& scene, const Vector<N>& start,
                                  const Vector<N>& direction)
    : scene_(scene), tolerance_root_(eighth_root(scene.tolerance)), launch_{start, direction, 0.0} {
  ray_.hits.resize(scene.bodies.balls.size());
  ray_.disc_hits.resize(scene.bodies.discs.size());
  for (const Disc& disc : scene.bodies.discs)
    passages_.push_back({first_side(disc, value_of(start), value_of(direction))});
  launch_.excess = medium_at(scene.masses, start).excess;
  at_ = first_point(scene.masses, launch_);
  h_ = kFirstStep / (std::sqrt(at_.medium.closeness2) * value_of(1.0 + launch_.excess));
  if (!(at_.medium.sum < 1.0)) {
    end_captured();
  } else if (heading() == Heading::Away && is_far()) {
    arrive();
  }
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
  const Vec3 x = value_of(at_.x), p = value_of(at_.p);
  Heading heading = Heading::Away;
  for (const PointMass& mass : scene_.masses) {
    const Vec3 r = x - mass.position;
    if (r.dot(p) > 0.0) continue;
    const double photon = kPhotonSphere * mass.m;
    if (r.dot(r) < photon * photon && !hides_body(mass)) return Heading::Captured;
    heading = Heading::Towards;
  }
  return heading;
}

template <class N>
bool GeodesicFlight<N>::may_meet_bodies(double bend) const {
  const Vec3 x = value_of(at_.x), d = value_of(at_.p).normalized();
  const auto& [balls, discs] = scene_.bodies;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!ray_.hits[i].hit && is_outside(balls[i], x) && may_come_near(balls[i], x, d, bend)) return true;
  }
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& disc = discs[i];
    if (ray_.disc_hits[i].hit || passages_[i].side * disc.normal.dot(d) > 2.0 * bend) continue;
    const Ball round{disc.centre, disc.outer};
    if (!is_outside(round, x) || may_come_near(round, x, d, bend)) return true;
  }
  return false;
}

template <class N>
bool GeodesicFlight<N>::is_far() const {
  const Vec3 x = value_of(at_.x), d = value_of(at_.p).normalized();
  double bend = 0.0, slope = 0.0;  // of what is to come, and its derivative by x
  for (const PointMass& mass : scene_.masses) {
    const Vec3 r = x - mass.position;
    const double distance = r.length(), z = r.dot(d);
    const double per_metre = 2.0 * mass.m / (distance * (distance + z));
    bend += per_metre * (r - d * z).length();
    slope += per_metre;
  }
  // What the first order leaves out is S times as large.
  const double rest = 2.0 * at_.medium.sum * (bend + slope * spread(launch_, at_));
  return rest < scene_.tolerance && !may_meet_bodies(bend);
}

template <class N>
Outlook<N> GeodesicFlight<N>::outlook(const Vector<N>& direction) const {
  using std::log, std::sqrt;
  Outlook<N> outlook;
  for (const PointMass& mass : scene_.masses) {
    const Vector<N> from = relative_to(mass.position, at_.x);
    const Vector<N> before = relative_to(mass.position, launch_.start);
    const N z = from.dot(direction), r = sqrt(from.dot(from));
    const Vector<N> b = from - times(direction, z);
    const N share = (2.0 * mass.m) * reciprocal(r + z);
    outlook.bend -= times(b, share * reciprocal(r));  // 2m/b (1 - z/r)
    outlook.shift += times(b, share);                 // what it bends, summed up along the way
    outlook.delay += (2.0 * mass.m) * log(2.0 * sqrt(before.dot(before)) * reciprocal(r + z));
  }
  // Second order: n = 1 + 4S + 7S^2, and far from all masses S falls as 1/r.
  const double s = at_.medium.sum;
  const double fall = -0.25 * value_of(at_.medium.force).dot(value_of(direction));
  if (fall > 0.0) outlook.delay += N(7.0 * s * s * (s / fall));
  return outlook;
}

template <class N>
void GeodesicFlight<N>::arrive() {
  using std::sqrt;
  flies_ = false;
  const Vector<N> tangent = times(at_.p, reciprocal(N(1.0) + at_.medium.excess));
  const Outlook<N> rest = outlook(tangent);
  const Vector<N> bent = tangent + rest.bend;
  ray_.direction = times(bent, reciprocal(sqrt(bent.dot(bent))));
  const Vector<N> far = at_.x + rest.shift - launch_.start;
  ray_.position = launch_.start + (far - times(ray_.direction, far.dot(ray_.direction)));
  // t + time - (x - start).direction, without loss of digits: x - start = (1 + excess) t d + xi.
  const Vector<N> turn = ray_.direction - launch_.direction;
  const N lag = 0.5 * turn.dot(turn);  // 1 - cos
  const N behind = lag - launch_.excess * (1.0 - lag);
  ray_.delay = at_.t * behind + (at_.time - at_.xi.dot(ray_.direction)) + rest.delay;
  if (!(is_finite(ray_.direction) && is_finite(ray_.position) && is_finite(ray_.delay))) end_captured();
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
  if (++steps_ == kMaxGeodesicSteps) return end_captured();
  const double wish = kCaution * tolerance_root_ / step.error_root;  // a NaN on a mass
  const double factor = wish > kSlowest ? std::min(wish, kFastest) : kSlowest;
  if (!(step.error_root < tolerance_root_ && step.largest_sum < 1.0)) {
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
  const Heading heading = this->heading();
  if (heading == Heading::Captured) return end_captured();
  if (heading == Heading::Away && is_far()) arrive();
}

template class GeodesicFlight<double>;
template class GeodesicFlight<Dual>;

}  // namespace lensplane
