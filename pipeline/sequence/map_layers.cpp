// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/map_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "pipeline/composite/map_jacobian.h"
#include "pipeline/image/failure.h"
#include "pipeline/sequence/fingerprint.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

std::filesystem::path existing(const Shot& shot, const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    throw Failure(ExitCode::BadInput,
                  fmt::format("{}: no such map; lensplane map {} makes it", path.string(), shot.file));
  }
  return path;
}

std::filesystem::path existing_map(const Shot& shot, const Layer& layer, int frame) {
  return existing(shot, map_path(shot, layer.name, frame));
}

std::filesystem::path existing_shadow(const Shot& shot, int frame) {
  return existing(shot, shadow_path(shot, frame));
}

/// Whether any layer has a map: stars have none.
bool has_maps(const Shot& shot) {
  return std::any_of(shot.layers.begin(), shot.layers.end(),
                     [](const Layer& layer) { return !std::holds_alternative<StarsLayer>(layer.kind); });
}

StMap read_map_of(const Camera& camera, const std::filesystem::path& path) {
  StMap map = read_st_map(path);
  const bool same = map.width == camera.full_width() && map.height == camera.full_height() &&
                    map.x == -camera.overscan && map.y == -camera.overscan &&
                    map.display_width == camera.width && map.display_height == camera.height;
  if (!same) {
    throw Failure(ExitCode::BadInput,
                  fmt::format("{}: a map of {} x {} pixels from ({}, {}); the shot's camera has {} x {} from "
                              "({}, {})",
                              path.string(), map.width, map.height, map.x, map.y, camera.full_width(),
                              camera.full_height(), -camera.overscan, -camera.overscan));
  }
  return map;
}

}  // namespace

double distance_of(const Surface& surface, const Vec3& camera) {
  if (const auto* sphere = std::get_if<Sphere>(&surface)) return (sphere->centre - camera).length();
  if (const auto* ring = std::get_if<Ring>(&surface)) return (ring->centre - camera).length();
  if (const auto* card = std::get_if<Card>(&surface)) return card->distance;
  return std::numeric_limits<double>::infinity();
}

std::vector<std::size_t> depth_order(const Shot& shot, int frame) {
  const Scene scene = scene_at(shot, frame);
  const auto surfaces = map_surfaces_of(shot);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    if (surfaces[k]) order.push_back(k);
  }
  const auto surface_of = [&](std::size_t k) -> const Surface& { return scene.surfaces[*surfaces[k]]; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double of_a = distance_of(surface_of(a), scene.camera.position),
                 of_b = distance_of(surface_of(b), scene.camera.position);
    if (of_a != of_b) return of_a > of_b;
    return std::holds_alternative<LatLong>(surface_of(a)) && !std::holds_alternative<LatLong>(surface_of(b));
  });
  return order;
}

std::vector<MapLayer> load_map_layers(const Shot& shot, const Scene& scene,
                                      const std::vector<SurfaceLook>& looks, int frame) {
  std::vector<MapLayer> layers;
  const auto surfaces = map_surfaces_of(shot);
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    if (!surfaces[k]) continue;  // stars
    const std::filesystem::path path = existing_map(shot, shot.layers[k], frame);
    const Surface& surface = scene.surfaces[*surfaces[k]];
    MapLayer layer;
    layer.map = read_map_of(scene.camera, path);
    layer.look = looks[*surfaces[k]];
    layer.distance = distance_of(surface, scene.camera.position);
    layer.surface = surface;
    const PixelWindows& picture = layer.look.texture->windows();
    const MappedPicture mapped{
        picture.display_width, picture.display_height,
        std::holds_alternative<LatLong>(surface) || std::holds_alternative<Sphere>(surface), false};
    MapData data;
    if (const auto data_file = data_file_beside(path)) data = read_map_data(*data_file, layer.map);
    layer.depth = std::move(data.depth);
    layer.footprints = data.jacobian ? footprints_from_jacobian(layer.map, *data.jacobian, mapped)
                                     : footprints_from_differences(layer.map, mapped);
    layers.push_back(std::move(layer));
  }
  return layers;
}

std::vector<float> load_shadow(const Shot& shot, const std::vector<MapLayer>& layers, int frame) {
  if (layers.empty() || shot.lenses.empty()) return {};
  std::vector<float> shadow = read_map_data(existing_shadow(shot, frame), layers.front().map).alpha;
  for (float& share : shadow) share = share > 0 ? std::min(share, 1.0F) : 0.0F;  // no number: 0
  return shadow;
}

std::string digest_of_maps(const Shot& shot, int frame) {
  Fingerprint print;
  for (const Layer& layer : shot.layers) {
    if (std::holds_alternative<StarsLayer>(layer.kind)) continue;
    const std::filesystem::path path = existing_map(shot, layer, frame);
    print.add_file(path);
    if (const auto data_file = data_file_beside(path)) print.add("data").add_file(*data_file);
  }
  if (!shot.lenses.empty() && has_maps(shot)) print.add("shadow").add_file(existing_shadow(shot, frame));
  return print.digest();
}

}  // namespace lensplane
