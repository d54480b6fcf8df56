// SPDX-License-Identifier: Apache-2.0

#include "src/bundle_way.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/plan_bounds.h"
#include "src/planes_march.h"

namespace lensplane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The bundle at one plane.
struct Front {
  const Vec3& start;
  const Vec3& direction;
  double across, spread, unseen_angle;

  double along(const Vec3& point) const { return (point - start).dot(direction); }
  double widening() const { return spread * (1.0 + spread); }
  double aside(const Deflector& deflector) const {
    return across + std::abs(along(deflector.position)) * widening();
  }
  BundlePass pass(const Deflector& deflector) const {
    const double b = length(deflector.position - start - direction * along(deflector.position));
    const double aside = this->aside(deflector);
    const double unseen = unseen_angle * length(deflector.position);
    return {&deflector, std::max(b - aside, unseen), b + aside};
  }
};

bool is_near(const BundlePass& pass) {
  const Deflector& deflector = *pass.deflector;
  return deflector.index * pass.least_b < kWildRatio * kCriticalRatio * deflector.m;
}

/// The mass that captures all rays, if there is one: of a camera that is well outside of its photon sphere.
const Deflector* captor_of(const std::vector<BundlePass>& passes, std::size_t begin) {
  for (std::size_t i = begin; i < passes.size(); ++i) {
    const Deflector& deflector = *passes[i].deflector;
    const bool far = length(deflector.position) > 2.0 * kCriticalRatio * deflector.m;
    if (far && deflector.position.z < 0.0 &&
        deflector.index * passes[i].most_b < kCriticalRatio * deflector.m)
      return &deflector;
  }
  return nullptr;
}

/// Masses that the rays may pass anywhere.
void add_unknown(const DeflectorPlane& plane, double unseen_angle, std::vector<BundlePass>& passes) {
  for (const Deflector& deflector : plane.deflectors)
    passes.push_back({&deflector, unseen_angle * length(deflector.position), kInfinity});
}

}  // namespace

double growth_at(double m, double b) {
  const Deflection d = exact_law(m, b);
  return std::max(-d.dalpha_db, d.alpha / b);
}

BundleWay follow_bundle(const Deflectors& everything, const Vec3& direction, double spread,
                        double unseen_angle) {
  BundleWay way;
  const RayPath<double> path = march_planes(everything, direction);
  double across = 0.0;
  std::size_t k = 0;
  for (; k < everything.outward && !way.lost; ++k) {
    const DeflectorPlane& plane = everything.planes[k];
    const RaySegment<double>& segment = path.segments[2 * k];  // each plane adds two
    const Front front{segment.start, segment.direction, across, spread, unseen_angle};
    BundlePlane passed{std::abs(front.along(plane.centre)), 0.0, way.passes.size(), 0};
    double more_spread = 0.0;
    way.lost = !(spread < 0.5) || 2 * (k + 1) >= path.segments.size();
    for (const Deflector& deflector : plane.deflectors) {
      const BundlePass pass = front.pass(deflector);
      way.passes.push_back(pass);
      passed.way = std::max(passed.way, std::abs(front.along(deflector.position)));
      way.lost = way.lost || is_near(pass);
      if (way.lost) continue;
      const double growth = growth_at(deflector.m, pass.least_b);
      passed.growth += growth;
      more_spread +=
          std::min(growth * front.aside(deflector), 2.0 * exact_law(deflector.m, pass.least_b).alpha);
    }
    passed.end = way.passes.size();
    way.stretches.push_back({segment.start, segment.direction, passed.way, across, spread});
    way.lost = way.lost || passed.growth * passed.way > kWildGrowth;
    if (plane.deflectors.size() == 1 && spread < 0.5) way.captor = captor_of(way.passes, passed.begin);
    if (way.captor) {
      way.lost = false;
      return way;
    }
    if (way.lost) continue;
    way.planes.push_back(passed);
    across += passed.way * front.widening();
    spread += more_spread;
  }
  if (!way.lost) {
    const RaySegment<double>& last = path.segments[2 * everything.outward];
    way.stretches.push_back({last.start, last.direction, kInfinity, across, spread});
    way.lost = path.captured || path.bends != static_cast<int>(everything.outward);
    k = way.lost ? 0 : everything.planes.size();  // light that has turned back may meet any of them again
  }
  for (; k < everything.planes.size(); ++k) add_unknown(everything.planes[k], unseen_angle, way.passes);
  return way;
}

}  // namespace lensplane
