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

Vec3 target_of(const Shot& shot, const LookAt& look_at, double frame) {
  if (const auto* lens = std::get_if<LensIndex>(&look_at.target)) {
    return value_at(shot.lenses[lens->index].position, frame);
  }
  if (const auto* layer = std::get_if<LayerIndex>(&look_at.target)) {
    return value_at(std::get<SphereLayer>(shot.layers[layer->index].kind).centre, frame);
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

Surface surface_at(const Layer& layer, double frame) {
  if (std::holds_alternative<PlateLayer>(layer.kind)) return Plate{};
  if (std::holds_alternative<LatLongLayer>(layer.kind)) return LatLong{};
  const auto& sphere = std::get<SphereLayer>(layer.kind);
  return Sphere{value_at(sphere.centre, frame), value_at(sphere.radius, frame),
                basis_from_zxy(value_at(sphere.rotation, frame))};
}

}  // namespace

Scene scene_at(const Shot& shot, double frame) {
  Scene scene;
  Camera& camera = scene.camera;
  camera.width = shot.camera.width;
  camera.height = shot.camera.height;
  camera.overscan = shot.camera.overscan;
  camera.projection = shot.camera.projection;
  camera.fov_rad = fov_at(shot.camera, frame);
  camera.position = value_at(shot.camera.position, frame);
  camera.axes = axes_at(shot, camera.position, frame);
  for (const LensTrack& lens : shot.lenses) {
    scene.lenses.push_back({value_at(lens.m, frame), value_at(lens.position, frame)});
  }
  for (const Layer& layer : shot.layers) scene.surfaces.push_back(surface_at(layer, frame));
  return scene;
}

TraceSettings trace_at(const Shot& shot, double frame) {
  const TraceTrack& trace = shot.trace;
  return {trace.method, trace.law, value_at(trace.tolerance_px, frame), trace.finite_distance,
          shot.output.data};
}

std::optional<Vec3> light_at(const Layer& layer, double frame) {
  const auto* sphere = std::get_if<SphereLayer>(&layer.kind);
  if (!sphere || !sphere->light) return std::nullopt;
  // Between keys that point in opposite directions the light may vanish for an instant.
  return value_at(*sphere->light, frame).normalized();
}

Shot proxy_of(Shot shot, int divisor) {
  CameraTrack& camera = shot.camera;
  camera.width = std::max(1, camera.width / divisor);
  camera.height = std::max(1, camera.height / divisor);
  camera.overscan = camera.overscan / divisor / 2 * 2;
  return shot;
}

}  // namespace lensplane
