// SPDX-License-Identifier: Apache-2.0

#include "src/deflectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/dual.h"

namespace lensplane {
namespace {

DeflectorPlane deflector_plane(const LensPlane& plane, Law law, bool finite_distance) {
  DeflectorPlane result;
  for (const Source& source : plane.sources) {
    const double index = finite_distance ? fermat_index(source.m, length(source.position)) : 1.0;
    result.deflectors.push_back({source.m, source.position, law, source.lens, index});
    const auto count = static_cast<double>(result.deflectors.size());
    result.centre += (source.position - result.centre) / count;
  }
  return result;
}

bool inside_horizon(const LensPlane& plane) {
  return std::any_of(plane.sources.begin(), plane.sources.end(),
                     [](const Source& source) { return length(source.position) <= kHorizon * source.m; });
}

}  // namespace

double fermat_index(double m, double rho) {
  const double s = m / (2.0 * rho);
  if (!(s < 1.0)) return std::numeric_limits<double>::infinity();
  return (1.0 + s) * (1.0 + s) * (1.0 + s) / (1.0 - s);
}

Deflectors deflectors_of(const Scene& scene, Law law, bool finite_distance) {
  const bool flat = scene.camera.projection == Projection::Perspective;
  std::vector<LensPlane> planes = lens_planes(scene, Method::Planes);
  Deflectors result;
  result.flat = flat;
  result.finite_distance = finite_distance || !flat;
  result.blind = std::any_of(planes.begin(), planes.end(), inside_horizon);
  // With the finite distance of the camera, planes behind it bend its light, too, by what is left of them.
  const auto first_in_front = std::stable_partition(planes.begin(), planes.end(), [&](const LensPlane& p) {
    return result.finite_distance || p.distance > 0;
  });
  result.outward = static_cast<std::size_t>(first_in_front - planes.begin());
  std::stable_sort(planes.begin(), first_in_front, [](const LensPlane& a, const LensPlane& b) {
    return std::abs(a.distance) < std::abs(b.distance);
  });
  for (const LensPlane& plane : planes) {
    result.planes.push_back(deflector_plane(plane, law, result.finite_distance));
  }
  return result;
}

}  // namespace lensplane
