// SPDX-License-Identifier: Apache-2.0

#include "src/lens_planes.h"

#include <algorithm>
#include <cmath>

namespace lensplane {
namespace {

struct PlacedSource {
  Source source;
  std::size_t index;  // among the lenses of the scene
  double z;
  double distance;
};

std::vector<PlacedSource> sources_in_camera_axes(const Scene& scene) {
  std::vector<PlacedSource> placed;
  for (std::size_t i = 0; i < scene.lenses.size(); ++i) {
    const Lens& lens = scene.lenses[i];
    if (lens.m == 0.0) continue;
    const Vec3 p = scene.camera.axes.local_from_parent(lens.position - scene.camera.position);
    placed.push_back({{lens.m, p.x, p.y}, i, p.z, std::hypot(p.x, p.y, p.z)});
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

/// The end of the sources, sorted by depth, that share a plane with the first.
auto end_of_plane(auto first, auto end) {
  return std::find_if(first, end,
                      [&](const PlacedSource& p) { return first->z - p.z > kEqualDepth * p.distance; });
}

}  // namespace

std::vector<LensPlane> lens_planes(const Scene& scene, Method method) {
  std::vector<PlacedSource> placed = sources_in_camera_axes(scene);
  if (method == Method::Kishi) return single_mean_plane(placed);

  std::sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.z > b.z; });
  std::vector<LensPlane> planes;
  for (auto first = placed.begin(); first != placed.end();) {
    const auto last = end_of_plane(first, placed.end());
    // Within a plane rounding has decided on the order so far.
    std::sort(first, last, [](const auto& a, const auto& b) { return a.index < b.index; });
    planes.push_back({first->z, {}});
    for (; first != last; ++first) planes.back().sources.push_back(first->source);
  }
  return planes;
}

}  // namespace lensplane
