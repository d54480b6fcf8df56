// SPDX-License-Identifier: Apache-2.0

#include "src/path_excess.h"

#include <algorithm>
#include <cmath>

namespace lensplane {

double excess_over_straight_line(const PathExcess& path, double way, const Vec3& aside) {
  PathExcess p = path;
  p.go(way);
  // With d the last direction, the end lies at e = L d - U + C, C being all detours; length = L + A. The
  // difference of length^2 and |e|^2:
  const double detour2 = p.detours.dot(p.detours);
  const double longer2 =
      p.spread + 2.0 * p.straight * p.rounding + (p.arcs * p.arcs - detour2) + 2.0 * p.lean.dot(p.detours);
  const double length = p.straight + p.arcs;
  const double line = std::sqrt(std::max(length * length - longer2, 0.0));
  if (!(length > 0.0)) return 0.0;
  // To the end that lies aside: |e + aside| - |e|.
  const double aside2 = 2.0 * (p.detours - p.lean).dot(aside) + aside.dot(aside);
  const double line_aside = std::sqrt(std::max(line * line + aside2, 0.0));
  const double farther = line + line_aside > 0.0 ? aside2 / (line + line_aside) : 0.0;
  return longer2 / (length + line) - farther;
}

}  // namespace lensplane
