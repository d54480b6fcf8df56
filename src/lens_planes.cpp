// SPDX-License-Identifier: Apache-2.0

#include "src/lens_planes.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lensplane {
namespace {

struct PlacedSource {
  Source source;
  std::size_t index;  // among the lenses of the scene
  double distance;    // from the camera
  double depth;       // along the normal of its plane
};

std::vector<PlacedSource> sources_in_camera_axes(const Scene& scene) {
  const bool flat = scene.camera.projection == Projection::Perspective;
  std::vector<PlacedSource> placed;
  for (std::size_t i = 0; i < scene.lenses.size(); ++i) {
    const Lens& lens = scene.lenses[i];
    if (lens.m == 0.0) continue;
    const Vec3 p = scene.camera.axes.local_from_parent(lens.position - scene.camera.position);
    const double distance = std::hypot(p.x, p.y, p.z);
    placed.push_back({{lens.m, p, i}, i, distance, flat ? -p.z : distance});
  }
  return placed;
}

std::vector<LensPlane> single_mean_plane(const std::vector<PlacedSource>& placed) {
  LensPlane plane{{0, 0, -1}, 0.0, {}};
  double total_mass = 0.0;
  for (const PlacedSource& p : placed) {
    if (!(p.depth > 0.0)) continue;
    plane.sources.push_back(p.source);
    total_mass += p.source.m;
    plane.distance += (p.depth - plane.distance) * (p.source.m / total_mass);  // this cannot overflow
  }
  if (plane.sources.empty()) return {};
  for (Source& source : plane.sources) source.position.z = -plane.distance;
  return {plane};
}

/// The end of the sources, sorted by depth, that share a plane with the first.
auto end_of_plane(auto first, auto end) {
  return std::find_if(
      first, end, [&](const PlacedSource& p) { return p.depth - first->depth > kEqualDepth * p.distance; });
}

std::vector<LensPlane> parallel_planes(std::vector<PlacedSource> placed) {
  std::vector<LensPlane> planes;
  for (auto first = placed.begin(); first != placed.end();) {
    const auto last = end_of_plane(first, placed.end());
    // Within a plane rounding has decided on the order so far.
    std::sort(first, last, [](const auto& a, const auto& b) { return a.index < b.index; });
    planes.push_back({{0, 0, -1}, first->depth, {}});
    for (; first != last; ++first) planes.back().sources.push_back(first->source);
  }
  return planes;
}

/// A source at the camera has no direction; any will do, for it captures everything.
std::vector<LensPlane> perpendicular_planes(const std::vector<PlacedSource>& placed) {
  std::vector<LensPlane> planes;
  for (const PlacedSource& p : placed) {
    if (!planes.empty() && planes.back().sources.front().position == p.source.position) {
      planes.back().sources.push_back(p.source);
      continue;
    }
    const Vec3 normal = p.distance > 0.0 ? p.source.position / p.distance : Vec3(0, 0, -1);
    planes.push_back({normal, p.distance, {p.source}});
  }
  return planes;
}

/// Sources as good as at one point become one; long double, because thousands may.
std::vector<Source> bodies(std::vector<Source> sources) {
  std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) {
    return std::tie(a.position.x, a.position.y, a.position.z, a.m, a.lens) <
           std::tie(b.position.x, b.position.y, b.position.z, b.m, b.lens);
  });
  std::vector<Source> merged;
  for (auto first = sources.begin(); first != sources.end();) {
    long double m = 0.0L;
    Vec3 centre = first->position;
    auto last = first;
    for (; last != sources.end(); ++last) {
      const Vec3 apart = last->position - centre;
      const double joint = static_cast<double>(m) + last->m;
      if (last != first && std::hypot(apart.x, apart.y, apart.z) > kOneBody * joint) break;
      m += last->m;
      centre += apart * (last->m / joint);
    }
    merged.push_back({static_cast<double>(m), centre, first->lens});
    first = last;
  }
  return merged;
}

}  // namespace

std::vector<LensPlane> lens_planes(const Scene& scene, Method method) {
  const bool flat = scene.camera.projection == Projection::Perspective;
  std::vector<PlacedSource> placed = sources_in_camera_axes(scene);
  if (method == Method::Kishi && flat) return single_mean_plane(placed);

  std::sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) {
    return std::tie(a.depth, a.source.position.x, a.source.position.y, a.source.position.z, a.index) <
           std::tie(b.depth, b.source.position.x, b.source.position.y, b.source.position.z, b.index);
  });
  std::vector<LensPlane> planes = flat ? parallel_planes(std::move(placed)) : perpendicular_planes(placed);
  if (method == Method::Planes) {
    for (LensPlane& plane : planes) plane.sources = bodies(std::move(plane.sources));
  }
  return planes;
}

}  // namespace lensplane
