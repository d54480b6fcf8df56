// SPDX-License-Identifier: Apache-2.0

#include "src/geodesic_flight.h"

#include "src/geodesic_entry.h"

namespace lensplane {
namespace {

/// Steps reach no farther than this share of the way to the nearest mass, so that none is overlooked.
constexpr double kFirstStep = 0.5, kLongestStep = 0.9;

/// From one step to the next, the change of length in proportion to the distance from the nearest mass.
constexpr double kSlowest = 0.2, kFastest = 6.0, kCaution = 0.9;
constexpr double kReceding = 1.2;

/// ratio^(-1/8), which unlike std::pow is the same on every machine.
double step_factor(double ratio) {
  return 1.0 / std::sqrt(std::sqrt(std::sqrt(ratio)));
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

}  // namespace

template <class N>
GeodesicFlight<N>::GeodesicFlight(const GeodesicScene& scene, const Vector<N>& start,
                                  const Vector<N>& direction)
    : scene_(scene), launch_{start, direction, 0.0} {
  ray_.hits.resize(scene.balls.size());
  launch_.excess = medium_at(scene.masses, start).excess;
  at_ = first_point(scene.masses, launch_);
  h_ = kFirstStep * at_.medium.nearest / value_of(1.0 + launch_.excess);
  flies_ = at_.medium.sum < 1.0;
  ray_.captured = !flies_;
  if (flies_ && is_far()) arrive();
}

template <class N>
bool GeodesicFlight<N>::falls_in() const {
  for (const PointMass& mass : scene_.masses) {
    const Vec3 r = value_of(at_.x) - mass.position;
    const double photon = kPhotonSphere * mass.m;
    if (r.dot(value_of(at_.p)) < 0.0 && r.dot(r) < photon * photon) return true;
  }
  return false;
}

template <class N>
bool GeodesicFlight<N>::may_meet_balls(double bend) const {
  const Vec3 d = value_of(at_.p).normalized();
  for (std::size_t i = 0; i < scene_.balls.size(); ++i) {
    const Ball& ball = scene_.balls[i];
    const Vec3 q = value_of(at_.x) - ball.centre;
    const double ahead = -q.dot(d);
    if (ray_.hits[i].hit || !(ahead > 0.0) || !is_outside(ball, value_of(at_.x))) continue;
    if ((q + d * ahead).length() <= ball.radius + 2.0 * bend * ahead) return true;
  }
  return false;
}

template <class N>
bool GeodesicFlight<N>::is_far() const {
  const Vec3 x = value_of(at_.x), p = value_of(at_.p);
  for (const PointMass& mass : scene_.masses) {
    if (!((x - mass.position).dot(p) > 0.0)) return false;
  }
  const Vec3 d = p.normalized();
  double bend = 0.0;
  for (const PointMass& mass : scene_.masses) {
    const Vec3 r = x - mass.position;
    const double distance = r.length(), z = r.dot(d);
    bend += 2.0 * mass.m * (r - d * z).length() / (distance * (distance + z));
  }
  return 2.0 * at_.medium.sum * bend < scene_.tolerance && !may_meet_balls(bend);
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
  if (is_finite(ray_.direction) && is_finite(ray_.position) && is_finite(ray_.delay)) return;
  ray_ = {.captured = true, .hits = std::move(ray_.hits)};
}

template <class N>
void GeodesicFlight<N>::go_on(const RayStep<N>& step) {
  flies_ = ++steps_ < kMaxGeodesicSteps;
  ray_.captured = !flies_;
  const double ratio = step.error / scene_.tolerance;
  const double factor =
      std::isfinite(ratio) ? std::clamp(kCaution * step_factor(ratio), kSlowest, kFastest) : kSlowest;
  if (!(ratio < 1.0 && step.largest_sum < 1.0)) {
    h_ *= std::min(factor, kCaution);
    return;
  }
  for (std::size_t i = 0; i < scene_.balls.size(); ++i) {
    const Ball& ball = scene_.balls[i];
    if (ray_.hits[i].hit || !may_enter(ball, at_, h_, step)) continue;
    const auto entry = find_entry(scene_.masses, launch_, at_, h_, step, ball);
    if (entry) ray_.hits[i] = hit_at(launch_, *entry, ball);
  }
  const Medium<N>& medium = step.end.medium;
  h_ = std::min(h_ * factor * std::min(kReceding, medium.nearest / at_.medium.nearest),
                kLongestStep * medium.nearest / value_of(1.0 + medium.excess));
  at_ = step.end;
  if (falls_in()) {
    flies_ = false;
    ray_.captured = true;
  } else if (flies_ && is_far()) {
    arrive();
  }
}

template class GeodesicFlight<double>;
template class GeodesicFlight<Dual>;

}  // namespace lensplane
