// SPDX-License-Identifier: Apache-2.0

#include "src/lens_planes.h"

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

struct PlacedSource {
  Source source;
  double z;
  double distance;
};

std::vector<PlacedSource> sources_in_camera_axes(const Scene& scene) {
  std::vector<PlacedSource> placed;
  for (const Lens& lens : scene.lenses) {
    if (lens.m == 0.0) continue;
    const Vec3 p = scene.camera.axes.local_from_parent(lens.position - scene.camera.position);
    placed.push_back({{lens.m, p.x, p.y}, p.z, std::hypot(p.x, p.y, p.z)});
  }
  return placed;
}

std::vector<LensPlane> single_mean_plane(const std::vector<PlacedSource>& placed) {
  LensPlane plane{0.0, {}};
  double total_mass = 0.0;
  for (const PlacedSource& p : placed) {
    if (!(p.z < 0.0)) continue;
    plane.sources.push_back(p.source);
    total_mass += p.source.m;
    plane.z += (p.z - plane.z) * (p.source.m / total_mass);  // a running mean cannot overflow
  }
  if (plane.sources.empty()) return {};
  return {plane};
}

}  // namespace

std::vector<LensPlane> lens_planes(const Scene& scene, Method method) {
  std::vector<PlacedSource> placed = sources_in_camera_axes(scene);
  if (method == Method::Kishi) return single_mean_plane(placed);

  std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.z > b.z; });
  std::vector<LensPlane> planes;
  for (const PlacedSource& p : placed) {
    if (planes.empty() || planes.back().z - p.z > kEqualDepth * p.distance) planes.push_back({p.z, {}});
    planes.back().sources.push_back(p.source);
  }
  return planes;
}

}  // namespace lensplane
