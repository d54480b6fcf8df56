// SPDX-License-Identifier: Apache-2.0

#include "src/planes_march.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/finite_shift.h"
#include "src/rotation.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Number>
struct Line {
  Vector<Number> start;
  Vector<Number> direction;
};

/// What one plane does to a ray.
template <class Number>
struct Turning {
  Number ahead;  // from the start of the ray to the plane's reference point on it, metres; may be negative
  Line<Number> out;  // where the ray goes on: from the turned foot point
  Number arc;        // the way there, round the masses
  Corner corner;     // the same as the path's length needs it
};

/// The deflectors' sums over one plane. Each deflector's foot point lies `along` past the reference point;
/// `across` leads from the foot point to the mass.
template <class Number>
struct PlaneSums {
  Vector<Number> bend = constant<Number>(Vec3(0));     // sum of alpha, towards the masses
  Vector<Number> kink = constant<Number>(Vec3(0));     // sum of along alpha: bends happen at the foot points
  Vector<Number> shift = constant<Number>(Vec3(0));    // sum of alpha^2 across
  Vector<Number> outward = constant<Number>(Vec3(0));  // sum of (n - 1) across
  Number arc = 0.0;                                    // sum of alpha b
};

/// The ray after the plane: its direction turned by the sum of the angles, its foot points about their
/// masses. For one deflector this is the rotation about it, exactly.
template <class Number>
Turning<Number> turned(const Number& ahead, const Vector<Number>& reference, const Vector<Number>& direction,
                       const PlaneSums<Number>& sums) {
  const Turn<Number> r = turn(sums.bend.dot(sums.bend));
  const Vector<Number> inward = sums.kink * r.sine + sums.shift * r.versine + sums.outward;
  // The same rotation applied to `inward`, which is perpendicular to `direction`.
  const Vector<Number> rotated =
      inward - (sums.bend * r.versine + direction * r.sine) * inward.dot(sums.bend);
  const Vector<Number> out = direction * r.cosine + sums.bend * r.sine;
  const Vector<Number> detour = out * (sums.arc * r.sine) - rotated;
  const Vec3 turn = value_of(sums.bend * r.sine - direction * (sums.bend.dot(sums.bend) * r.versine));
  const double longer = value_of(sums.arc * (1.0 - r.sine));
  return {ahead, {reference + detour, out}, sums.arc, {turn, value_of(sums.arc), value_of(detour), longer}};
}

/// The corner of a ray that the plane, behind the camera, bends where it is.
Corner at_camera(const Corner& corner, double ahead) {
  const double lag = 0.5 * corner.turn.dot(corner.turn);  // 1 - cos
  return {corner.turn, corner.arc, corner.detour - corner.turn * ahead, corner.longer + ahead * lag};
}

/// How far a ray runs to a plane. With finite distance it never goes backwards: a mass behind the camera
/// bends it where it is.
template <class Number>
Number way_to(const Number& ahead, bool finite_distance) {
  return finite_distance && value_of(ahead) < 0.0 ? Number(0.0) : ahead;
}

/// Where a ray's line is nearest to a mass.
template <class Number>
struct FootPoint {
  Number along;           // metres from where the line begins
  Vector<Number> across;  // from there to the mass
  Number b;               // how far that is
};

template <class Number>
FootPoint<Number> foot_point(const Deflector& deflector, const Vector<Number>& start,
                             const Vector<Number>& direction) {
  const Vector<Number> to_mass = constant<Number>(deflector.position) - start;
  const Number along = to_mass.dot(direction);
  const Vector<Number> across = to_mass - direction * along;
  return {along, across, length(across)};
}

/// How far a ray along `direction` runs from the camera to its closest approach; nothing where that has no
/// influence.
template <class Number>
std::optional<Number> way_from_camera(const Deflector& deflector, bool finite_distance,
                                      const Vector<Number>& direction) {
  if (!finite_distance) return std::nullopt;
  return constant<Number>(deflector.position).dot(direction);
}

/// Metres from where light on a line that passes a mass at the distance `b` comes into its photon sphere to
/// where the line is nearest to the mass; 0 when it does not until there.
double way_through_photon_sphere(double m, double b) {
  const double radius = kPhotonSphere * m;
  if (!(b > 0.0)) return radius;
  const auto inside = [&](double ahead) {
    const double aside = b - 2.0 * m * b / (std::hypot(ahead, b) + ahead);
    return std::hypot(ahead, std::max(aside, 0.0)) < radius;
  };
  if (!inside(0.0)) return 0.0;
  double within = 0.0, before = radius;  // the light comes ever nearer
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (within + before);
    (inside(middle) ? within : before) = middle;
  }
  return before;
}

/// Metres along a line to where light ends that the mass captures.
double capture_way(const Deflector& deflector, const Vec3& start, const Vec3& direction) {
  const auto [along, across, b] = foot_point(deflector, start, direction);
  return along - way_through_photon_sphere(deflector.m, b);
}

/// Ends a path in a mass of the plane that its last stretch leads to. To an inclined ray a mass may lie
/// before those of planes that come first: then an earlier stretch ends there.
template <class Number>
void end_in_mass(const DeflectorPlane& plane, bool finite_distance, RayPath<Number>& path) {
  const RaySegment<Number>& last = path.segments.back();
  const auto capture = capture_by(plane, finite_distance, value_of(last.start), value_of(last.direction));
  if (!capture) return;
  double way = capture->way;
  while (way < 0.0 && path.segments.size() > 1) {
    path.segments.resize(path.segments.size() - 2);  // and the chord before it
    path.lengths.resize(path.segments.size());
    const RaySegment<Number>& ray = path.segments.back();
    path.bends = ray.bends;
    way = std::min(value_of(ray.length),
                   capture_way(*capture->mass, value_of(ray.start), value_of(ray.direction)));
  }
  path.segments.back().length = Number(finite_distance ? std::max(way, 0.0) : way);
}

/// Where the ray that ends `path` goes on behind a plane; nothing when it is captured, and ends, there.
template <class Number>
std::optional<Turning<Number>> turn_at(const DeflectorPlane& plane, bool finite_distance,
                                       RayPath<Number>& path) {
  const RaySegment<Number>& ray = path.segments.back();
  const Number ahead = (constant<Number>(plane.centre) - ray.start).dot(ray.direction);
  const Vector<Number> reference = ray.start + ray.direction * ahead;
  PlaneSums<Number> sums;
  for (const Deflector& deflector : plane.deflectors) {
    const auto [along, across, b] = foot_point(deflector, reference, ray.direction);
    const auto bent = bend_by(deflector, b, way_from_camera(deflector, finite_distance, ray.direction));
    if (!bent) {
      path.segments.back().length = way_to(ahead, finite_distance);
      end_in_mass(plane, finite_distance, path);
      return std::nullopt;
    }
    sums.bend += across * bent->per_b;
    sums.kink += across * (bent->per_b * along);
    sums.shift += across * (bent->alpha * bent->alpha);
    if (finite_distance) sums.outward += across * (deflector.index - 1.0);
    sums.arc += bent->alpha * b;
    path.passages.push_back({deflector.lens, deflector.m, length(deflector.position), b, bent->alpha,
                             path.lengths.back() + ahead + along, deflector.law,
                             finite_distance ? deflector.index : 1.0, finite_distance});
  }
  return turned(ahead, reference, ray.direction, sums);
}

/// Lets the ray go on from a plane, by the chord of its way round the masses.
template <class Number>
void go_on(const Turning<Number>& turning, bool finite_distance, RayPath<Number>& path) {
  const bool behind = finite_distance && value_of(turning.ahead) < 0.0;
  const Number way = way_to(turning.ahead, finite_distance);
  const Vector<Number> start =
      behind ? turning.out.start - turning.out.direction * turning.ahead : turning.out.start;
  path.segments.back().length = way;
  const RaySegment<Number> ray = path.segments.back();
  path.segments.push_back(straight_between(ray.start + ray.direction * way, start, ray));
  path.lengths.push_back(path.lengths.back() + way);
  path.segments.push_back({start, turning.out.direction, Number(kInfinity), ++path.bends});
  path.lengths.push_back(path.lengths.back() + turning.arc);
  path.corners.push_back(behind ? at_camera(turning.corner, value_of(turning.ahead)) : turning.corner);
}

/// The number of the segment by which a ray leaves the outward plane number `plane`: each plane adds two.
constexpr std::size_t segment_after(std::size_t plane) {
  return 2 * (plane + 1);
}

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The plane whose closest approach is the nearest ahead of a ray, among those that it does not just move
/// away from: `left` holds the direction in which it left each plane, zero where it never was.
std::size_t nearest_ahead(const std::vector<DeflectorPlane>& planes, const std::vector<Vec3>& left,
                          const Vec3& start, const Vec3& direction, std::size_t last) {
  std::size_t nearest = kNone;
  double least = kInfinity;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const bool returns = left[i] == Vec3(0) || left[i].dot(direction) < 0.0;
    const double ahead = (planes[i].centre - start).dot(direction);
    if (i == last || !returns || !(ahead > 0.0) || !(ahead < least)) continue;
    least = ahead;
    nearest = i;
  }
  return nearest;
}

/// Follows light that has turned back, or runs along the screen, until no mass lies ahead.
template <class Number>
void march_on(const Deflectors& deflectors, std::size_t passed, RayPath<Number>& path) {
  std::vector<Vec3> left(deflectors.planes.size(), Vec3(0));
  for (std::size_t i = 0; i < passed; ++i) left[i] = value_of(path.segments[segment_after(i)].direction);
  for (std::size_t last = passed - 1;;) {
    const RaySegment<Number>& ray = path.segments.back();
    const std::size_t next =
        nearest_ahead(deflectors.planes, left, value_of(ray.start), value_of(ray.direction), last);
    if (next == kNone) return;
    const auto turning = turn_at(deflectors.planes[next], false, path);
    path.captured = !turning;
    path.unresolved = turning && path.bends == kMaxCrossings;
    if (path.ended()) return;
    go_on(*turning, false, path);
    left[next] = value_of(path.segments.back().direction);
    last = next;
  }
}

/// Does light no longer move away from the screen; without a screen: has it turned by more than a right
/// angle?
template <class Number>
bool turned_back(const Deflectors& deflectors, const RayPath<Number>& path) {
  const Vec3 direction = value_of(path.segments.back().direction);
  if (deflectors.flat) return !(direction.z < 0.0);
  for (std::size_t i = 0; i < path.segments.size(); i += 2) {
    if (value_of(path.segments[i].direction).dot(direction) < 0.0) return true;
  }
  return false;
}

template <class Number>
Bend<Number> full_bend(const Deflector& deflector, const Number& b) {
  const Deflection law = entry_of(deflector.law).deflection(deflector.m, value_of(b));
  const Number alpha = chained(b, law.alpha, law.dalpha_db);
  return {alpha, alpha / b};
}

/// A bend with what the mass's company adds to it.
template <class Number>
Bend<Number> with_company(const Deflector& deflector, const Number& b, const Bend<Number>& bend) {
  if (deflector.law != Law::Exact || deflector.company.weight == 0.0) return bend;
  const Number gain = gain_in(deflector.company, b * b);
  return {bend.alpha + bend.alpha * gain, bend.per_b + bend.per_b * gain};
}

}  // namespace

template <class Number>
std::optional<Bend<Number>> bend_by(const Deflector& deflector, const Number& b,
                                    const std::optional<Number>& along) {
  const double m = deflector.m;
  const double b_c = entry_of(deflector.law).capture_ratio * m;
  const double b_far = deflector.index * value_of(b);
  if (!along) {
    if (value_of(b) <= b_c) return std::nullopt;  // as far away: no camera near
    return with_company(deflector, b, full_bend(deflector, b));
  }
  const bool ahead = value_of(*along) >= 0.0;
  const Number r = length(Vector<Number>(*along, b, Number(0.0)));  // from the mass to the camera
  const bool inside = value_of(r) < kPhotonSphere * m;
  if (ahead ? inside || b_far <= b_c : inside && b_far >= b_c) return std::nullopt;

  // 1 + cos R, over b and over b^2: behind the camera without cancellation, and finite as b -> 0.
  const Number cosine = *along / r;
  const Number per_b2 = ahead ? (1.0 + cosine) / (b * b) : 1.0 / (r * r * (1.0 - cosine));
  const Number per_b = per_b2 * b;
  const Number nearest = deflector.index * (ahead ? b : r);
  const Number excess = full_bend(deflector, nearest).alpha - (4.0 * m) / nearest;
  const Number excess_share = 0.25 * excess * (2.0 - cosine) * per_b * b;  // h(cos R), but for a factor
  const double weak = 2.0 * m / deflector.index;
  return with_company(
      deflector, b,
      Bend<Number>{weak * per_b + excess_share * per_b * b, weak * per_b2 + excess_share * per_b});
}

std::optional<Capture> capture_by(const DeflectorPlane& plane, bool finite_distance, const Vec3& start,
                                  const Vec3& direction) {
  std::optional<Capture> first;
  for (const Deflector& deflector : plane.deflectors) {
    const auto [along, across, b] = foot_point(deflector, start, direction);
    if (bend_by(deflector, b, way_from_camera(deflector, finite_distance, direction))) continue;
    const double way = capture_way(deflector, start, direction);
    if (!first || way < first->way) first = Capture{&deflector, way};
  }
  return first;
}

template <class Number>
RayPath<Number> march_planes(const Deflectors& deflectors, const Vector<Number>& direction) {
  RayPath<Number> path = path_from<Number>(constant<Number>(Vec3(0)), direction);
  path.captured = deflectors.blind;
  if (path.captured) path.segments.back().length = Number(0.0);
  std::size_t passed = 0;
  while (passed < deflectors.outward && !path.captured) {
    const auto turning = turn_at(deflectors.planes[passed], deflectors.finite_distance, path);
    path.captured = !turning;
    if (path.captured) break;
    go_on(*turning, deflectors.finite_distance, path);
    ++passed;
    if (deflectors.flat && !(value_of(path.segments.back().direction.z) < 0.0)) break;
  }
  if (!path.captured && passed > 0 && turned_back(deflectors, path)) march_on(deflectors, passed, path);
  return path;
}

template std::optional<Bend<double>> bend_by(const Deflector&, const double&, const std::optional<double>&);
template std::optional<Bend<Dual>> bend_by(const Deflector&, const Dual&, const std::optional<Dual>&);
template RayPath<double> march_planes(const Deflectors&, const Vec3&);
template RayPath<Dual> march_planes(const Deflectors&, const DualVec3&);

}  // namespace lensplane
