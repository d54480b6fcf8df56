// SPDX-License-Identifier: Apache-2.0

#include "src/company.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/mass_shift.h"

namespace lensplane {
namespace {

/// What gains less than this of its bend stays as it is, to the last bit.
constexpr double kNoGain = 1e-16;

/// A mass with the number of its plane.
struct Member {
  Deflector deflector;
  int plane;
};

std::vector<Member> members_of(const Deflectors& deflectors) {
  std::vector<Member> members;
  for (std::size_t k = 0; k < deflectors.planes.size(); ++k) {
    for (const Deflector& deflector : deflectors.planes[k].deflectors)
      members.push_back({deflector, static_cast<int>(k)});
  }
  return members;
}

/// How far the pull of `other` has brought the light aside that comes from the camera to `mass`. Planes that
/// only light meets that has turned back have bent none of it.
Vec3 pulled_aside(const Member& other, const Member& mass, int outward) {
  const double way = length(mass.deflector.position);
  const Vec3 direction = mass.deflector.position / way;
  const Bent bent =
      other.plane < outward && mass.plane < outward ? bent_by_plane(other.plane, mass.plane) : Bent::NotYet;
  return shift_by_mass(other.deflector, bent == Bent::NotYet ? bent : Bent::Before, Vec3(0), direction, way);
}

/// `aside`, which is across the line of sight, within a plane that is parallel to the screen: where on its
/// line of sight a mass stands is of no account. Beside the camera there is no such plane.
Vec3 within_plane(const Vec3& aside, const Vec3& position) {
  const bool beside = std::abs(position.z) < 0.1 * length(position);
  return beside ? aside : aside - position * (aside.z / position.z);
}

/// A mass among `members`, number `i` of them. Where numbers overflow it stays alone.
Deflector accompanied(const std::vector<Member>& members, std::size_t i, const Deflectors& deflectors) {
  Deflector result = members[i].deflector;
  if (!(length(result.position) > 0.0)) return result;
  Vec3 aside(0);
  double value = 0.0, curvature = 0.0;  // of the sum of m/sqrt(s^2 + c b^2) at b = 0: -c times that
  for (std::size_t j = 0; j < members.size(); ++j) {
    if (j == i) continue;
    const Deflector& other = members[j].deflector;
    const double s = length(other.position - result.position);
    value += other.m / s;
    curvature += other.m / (s * s * s);
    aside += pulled_aside(members[j], members[i], static_cast<int>(deflectors.outward));
  }
  const double spread = std::sqrt(value / curvature);
  const double weight = kCompanyGain * value * spread;
  if (!(value > kNoGain) || !std::isfinite(weight * spread * spread + length(aside))) return result;
  result.company = {weight, spread * spread, length(aside)};
  result.position -= deflectors.flat ? within_plane(aside, result.position) : aside;
  return result;
}

}  // namespace

double company_bend(double m, const Company& company, double b) {
  const Deflection bend = exact_law(m, b);
  return bend.alpha * gain_in(company, b * b) + company.aside * std::max(-bend.dalpha_db, bend.alpha / b);
}

Deflectors in_company(const Deflectors& deflectors) {
  Deflectors result = deflectors;
  const std::vector<Member> members = members_of(deflectors);
  if (members.size() < 2 || members.size() > kMostInCompany) return result;
  std::vector<Deflector> found(members.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, members.size(), 16), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) found[i] = accompanied(members, i, deflectors);
  });
  auto next = found.begin();
  for (DeflectorPlane& plane : result.planes) {
    plane.centre = Vec3(0);
    for (std::size_t i = 0; i < plane.deflectors.size(); ++i) {
      plane.deflectors[i] = *next++;
      plane.centre += (plane.deflectors[i].position - plane.centre) / static_cast<double>(i + 1);
    }
  }
  return result;
}

}  // namespace lensplane
