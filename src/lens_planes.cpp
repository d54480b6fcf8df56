// SPDX-License-Identifier: Apache-2.0

#include "src/lens_planes.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace lensplane {
namespace {

/// The sources of the scene in camera axes.
std::vector<Source> sources_of(const Scene& scene) {
  std::vector<Source> sources;
  for (std::size_t i = 0; i < scene.lenses.size(); ++i) {
    const Lens& lens = scene.lenses[i];
    if (lens.m == 0.0) continue;
    sources.push_back(
        {lens.m, scene.camera.axes.local_from_parent(lens.position - scene.camera.position), i});
  }
  return sources;
}

double distance_of(const Vec3& p) {
  return std::hypot(p.x, p.y, p.z);
}

void sort_by_position(std::vector<Source>& sources) {
  std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) {
    return std::tie(a.position.x, a.position.y, a.position.z, a.m, a.lens) <
           std::tie(b.position.x, b.position.y, b.position.z, b.m, b.lens);
  });
}

/// Sources that are as good as at one point.
struct Body {
  long double m;  // of thousands, perhaps
  Vec3 centre;
  std::size_t lens;  // the number of one of them
};

bool belongs_to(const Body& body, const Source& source) {
  const double apart = distance_of(source.position - body.centre);
  const double joint = static_cast<double>(body.m) + source.m;
  const double within = std::max(kOneBody * joint, kOnePlace * distance_of(source.position));
  return apart <= within && std::isfinite(apart);
}

void add(const Source& source, Body& body) {
  const long double joint = body.m + source.m;
  // Of infinite masses the first stays where it is; no quotient of them is a number.
  const double share = static_cast<double>(source.m / joint);
  if (share > 0.0) body.centre += (source.position - body.centre) * share;
  if (std::isfinite(body.m) && !std::isfinite(source.m)) body.centre = source.position;
  body.m = joint;
}

/// Sources as good as at one point become one. Going through them by rising x, each may belong to a body no
/// farther back than `reach`.
std::vector<Source> bodies(std::vector<Source> sources) {
  sort_by_position(sources);
  double total = 0.0, farthest = 0.0;
  for (const Source& source : sources) {
    total += source.m;
    farthest = std::max(farthest, distance_of(source.position));
  }
  const double reach = std::max(kOneBody * total, kOnePlace * farthest);
  std::vector<Body> found;
  std::ptrdiff_t near = 0;  // bodies before this one are out of reach
  for (const Source& source : sources) {
    while (near < std::ssize(found) &&
           source.position.x - found[static_cast<std::size_t>(near)].centre.x > reach)
      ++near;
    const auto body =
        std::find_if(found.begin() + near, found.end(), [&](const Body& b) { return belongs_to(b, source); });
    if (body == found.end()) {
      found.push_back({source.m, source.position, source.lens});
    } else {
      add(source, *body);
    }
  }
  std::vector<Source> merged;
  for (const Body& body : found) merged.push_back({static_cast<double>(body.m), body.centre, body.lens});
  sort_by_position(merged);
  return merged;
}

struct PlacedSource {
  Source source;
  std::size_t order;  // among the sources of its plane
  double distance;    // from the camera
  double depth;       // along the normal of its plane
};

std::vector<PlacedSource> placed(const std::vector<Source>& sources, bool flat) {
  std::vector<PlacedSource> result;
  for (const Source& source : sources) {
    const double distance = distance_of(source.position);
    result.push_back({source, result.size(), distance, flat ? -source.position.z : distance});
  }
  return result;
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
    std::sort(first, last, [](const auto& a, const auto& b) { return a.order < b.order; });
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

}  // namespace

std::vector<LensPlane> lens_planes(const Scene& scene, Method method) {
  const bool flat = scene.camera.projection == Projection::Perspective;
  std::vector<Source> sources = sources_of(scene);
  if (method == Method::Planes) sources = bodies(std::move(sources));
  std::vector<PlacedSource> sorted = placed(sources, flat);
  if (method == Method::Kishi && flat) return single_mean_plane(sorted);

  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return std::tie(a.depth, a.source.position.x, a.source.position.y, a.source.position.z, a.order) <
           std::tie(b.depth, b.source.position.x, b.source.position.y, b.source.position.z, b.order);
  });
  return flat ? parallel_planes(std::move(sorted)) : perpendicular_planes(sorted);
}

}  // namespace lensplane
