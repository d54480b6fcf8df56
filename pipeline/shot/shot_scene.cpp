// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/shot_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "src/constants.h"

namespace lensplane {
namespace {

double fov_at(const CameraTrack& camera, double frame) {
  if (const auto* lens = std::get_if<FocalLength>(&camera.fov)) {
    const double fov =
        2.0 * std::atan2(value_at(lens->film_width, frame) / 2.0, value_at(lens->focal_length, frame));
    if (fov >= kNarrowestFov && fov < kPi) return fov;
    refuse(lens->location, "camera.focal_length",
           fmt::format("at frame {} the field of view is {} rad; allowed: from 1e-15 to less than pi", frame,
                       fov));
  }
  return value_at(std::get<Keyed<double>>(camera.fov), frame);
}

/// Of a sphere or a ring.
Vec3 centre_at(const Shot& shot, const Layer& layer, double frame) {
  if (const auto* sphere = std::get_if<SphereLayer>(&layer.kind)) return value_at(sphere->centre, frame);
  const auto& ring = std::get<RingLayer>(layer.kind);
  if (const auto* other = std::get_if<LayerIndex>(&ring.centre)) {
    return centre_at(shot, shot.layers[other->index], frame);
  }
  return value_at(std::get<Keyed<Vec3>>(ring.centre), frame);
}

Vec3 target_of(const Shot& shot, const LookAt& look_at, double frame) {
  if (const auto* lens = std::get_if<LensIndex>(&look_at.target)) {
    return value_at(shot.lenses[lens->index].position, frame);
  }
  if (const auto* layer = std::get_if<LayerIndex>(&look_at.target)) {
    return centre_at(shot, shot.layers[layer->index], frame);
  }
  return value_at(std::get<Keyed<Vec3>>(look_at.target), frame);
}

Basis axes_at(const Shot& shot, const Vec3& position, double frame) {
  const auto& orientation = shot.camera.orientation;
  if (const auto* rotation = std::get_if<Rotation>(&orientation)) {
    return basis_from_zxy(value_at(rotation->angles, frame));
  }
  const auto& look_at = std::get<LookAt>(orientation);
  const Basis axes =
      basis_looking_along(target_of(shot, look_at, frame) - position, value_at(look_at.up, frame));
  if (!is_valid(axes)) {
    refuse(look_at.location, "camera.look_at",
           fmt::format("at frame {} the camera looks at its own position or straight along up", frame));
  }
  return axes;
}

Sphere sphere_at(const SphereLayer& sphere, double frame) {
  return {value_at(sphere.centre, frame), value_at(sphere.radius, frame),
          basis_from_zxy(value_at(sphere.rotation, frame))};
}

/// Axes whose +y is the normal; +z is as near to the world's as possible, or to its +x.
Basis axes_of_normal(const Vec3& normal) {
  const Vec3 towards = std::abs(normal.z) < 0.99 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  const Vec3 x = normal.cross(towards).normalized();
  return {x, normal, x.cross(normal)};
}

Surface surface_at(const Shot& shot, const LayerSurface& surface, double frame) {
  const Layer& layer = shot.layers[surface.layer];
  if (const auto* sphere = std::get_if<SphereLayer>(&layer.kind)) return sphere_at(*sphere, frame);
  if (const auto* ring = std::get_if<RingLayer>(&layer.kind)) {
    return Ring{centre_at(shot, layer, frame), axes_of_normal(value_at(ring->normal, frame)),
                value_at(ring->inner, frame), value_at(ring->outer, frame), surface.crossing};
  }
  const auto* plate = std::get_if<PlateLayer>(&layer.kind);
  if (plate && plate->distance) return Card{value_at(*plate->distance, frame), surface.crossing};
  return plate ? Surface(Plate{plate->bent}) : Surface(LatLong{});
}

/// How often light may be seen to cross the layer.
int crossings_of(const Shot& shot, const Layer& layer) {
  if (shot.lenses.empty()) return 1;  // straight light crosses what is flat once
  if (std::holds_alternative<RingLayer>(layer.kind)) return kRingCrossings;
  const auto* plate = std::get_if<PlateLayer>(&layer.kind);
  return plate && plate->distance ? kCardCrossings : 1;
}

}  // namespace

Scene scene_at(const Shot& shot, double frame) {
  Scene scene;
  Camera& camera = scene.camera;
  camera.width = shot.camera.width;
  camera.height = shot.camera.height;
  camera.overscan = shot.camera.overscan.value_or(0);
  camera.projection = shot.camera.projection;
  camera.fov_rad = fov_at(shot.camera, frame);
  camera.position = value_at(shot.camera.position, frame);
  camera.axes = axes_at(shot, camera.position, frame);
  for (const LensTrack& lens : shot.lenses) {
    scene.lenses.push_back({value_at(lens.m, frame), value_at(lens.position, frame)});
  }
  for (const LayerSurface& surface : surfaces_of(shot)) {
    scene.surfaces.push_back(surface_at(shot, surface, frame));
  }
  return scene;
}

std::vector<LayerSurface> surfaces_of(const Shot& shot) {
  std::vector<LayerSurface> first, more;
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    if (std::holds_alternative<StarsLayer>(shot.layers[k].kind)) continue;
    first.push_back({k, 0});
    for (int crossing = 1; crossing < crossings_of(shot, shot.layers[k]); ++crossing) {
      more.push_back({k, crossing});
    }
  }
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

std::vector<std::optional<std::size_t>> map_surfaces_of(const Shot& shot) {
  std::vector<std::optional<std::size_t>> result(shot.layers.size());
  const std::vector<LayerSurface> surfaces = surfaces_of(shot);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].crossing == 0) result[surfaces[i].layer] = i;
  }
  return result;
}

bool has_stars(const Shot& shot) {
  return std::any_of(shot.layers.begin(), shot.layers.end(),
                     [](const Layer& layer) { return std::holds_alternative<StarsLayer>(layer.kind); });
}

TraceSettings trace_at(const Shot& shot, double frame) {
  const TraceTrack& trace = shot.trace;
  return {trace.method, trace.law, value_at(trace.tolerance_px, frame), trace.finite_distance,
          shot.output.data};
}

std::optional<Vec3> light_at(const Layer& layer, double frame) {
  const auto* sphere = std::get_if<SphereLayer>(&layer.kind);
  if (!sphere || !sphere->light) return std::nullopt;
  return value_at(*sphere->light, frame);
}

double sun_at(const Layer& layer, double frame) {
  const auto* sphere = std::get_if<SphereLayer>(&layer.kind);
  return sphere ? value_at(sphere->light_diameter, frame) / 2 : 0.0;
}

std::optional<RingShadow> shadow_at(const Shot& shot, std::size_t layer, double frame) {
  const auto* ring = std::get_if<RingLayer>(&shot.layers[layer].kind);
  if (!ring || !ring->shadow_of) return std::nullopt;
  const auto& sphere = std::get<SphereLayer>(shot.layers[ring->shadow_of->index].kind);
  const Keyed<Direction>& light = ring->light ? *ring->light : *sphere.light;
  const Keyed<double>& diameter = ring->light ? ring->light_diameter : sphere.light_diameter;
  return RingShadow{sphere_at(sphere, frame), value_at(light, frame), value_at(diameter, frame) / 2};
}

Shot proxy_of(Shot shot, int divisor) {
  CameraTrack& camera = shot.camera;
  camera.width = std::max(1, camera.width / divisor);
  camera.height = std::max(1, camera.height / divisor);
  if (camera.overscan) camera.overscan = *camera.overscan / divisor / 2 * 2;
  return shot;
}

}  // namespace lensplane
