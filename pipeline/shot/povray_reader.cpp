// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/povray_reader.h"

#include "pipeline/shot/layer_reader.h"

namespace lensplane {
namespace {

constexpr int kNarrowestSky = 16, kWidestSky = 32768;  // pixels
constexpr int kMostAntialias = 8;

/// Refuses a key that has no meaning for what the scene is seen as.
void only_as(const Value& layer, std::string_view key, bool means_something, std::string_view allowed) {
  const auto value = layer.find(key);
  if (value && !means_something)
    value->refuse(std::string("has a meaning only with ") + std::string(allowed));
}

}  // namespace

Layer read_povray_layer(const Value& layer, const std::string& name) {
  PovRayScene scene;
  const Value path = layer.require("scene", "the path of a .pov file");
  scene.scene = {path.text(), path.location(), path.key()};
  if (const auto as = layer.find("as")) {
    constexpr std::array<std::string_view, 3> kNames = {"plate", "latlong", "bent"};
    scene.as = static_cast<PovRayAs>(as->choice(kNames));
  }
  if (const auto unit = layer.find("unit")) scene.unit_m = unit->positive(Dimension::Length);
  if (scene.as == PovRayAs::Bent) scene.antialias = PovRayScene::kBentAntialias;
  if (const auto antialias = layer.find("antialias")) scene.antialias = antialias->integer(1, kMostAntialias);
  if (const auto timeout = layer.find("timeout")) scene.timeout_s = timeout->positive(Dimension::Time);
  if (const auto width = layer.find("width")) {
    scene.width = width->integer(kNarrowestSky, kWidestSky);
    if (*scene.width % 2 != 0) width->refuse(in_quotes(width->text()) + " is odd; a lat-long is 2 : 1");
  }
  only_as(layer, "width", scene.as == PovRayAs::LatLong, "as: latlong");
  only_as(layer, "distance", scene.as == PovRayAs::Plate, "as: plate");
  only_as(layer, "edge", scene.as == PovRayAs::Plate, "as: plate");
  Layer result{name, {}, LatLongLayer{}, scene};
  result.image.pattern = scene.scene;  // until it is known where the pictures go
  if (scene.as != PovRayAs::LatLong) {
    PlateLayer plate = read_plate(layer);
    plate.bent = scene.as == PovRayAs::Bent;
    if (plate.bent) plate.edge = Edge::Clamp;  // it ends with the film
    result.kind = plate;
  }
  return result;
}

}  // namespace lensplane
