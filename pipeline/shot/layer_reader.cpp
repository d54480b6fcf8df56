// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/layer_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "pipeline/image/frame_path.h"
#include "pipeline/shot/povray_reader.h"
#include "src/constants.h"

namespace lensplane {
namespace {

enum class LayerType { Plate, LatLong, Sphere, Ring, Stars, PovRay };
constexpr std::array<std::string_view, 6> kTypeNames = {"plate", "latlong", "sphere",
                                                        "ring",  "stars",   "povray"};

LocatedText located_text(const Value& value) {
  return {value.text(), value.location(), value.key()};
}

LayerImage read_image(const Value& value) {
  if (!value.is_map()) return {located_text(value), std::nullopt, std::nullopt};
  value.only_keys({"file", "layer", "part", "missing", "space", "alpha"});
  LayerImage image{located_text(value.require("file", "the path of an image")), std::nullopt, std::nullopt};
  if (const auto layer = value.find("layer")) image.choice.layer = layer->text();
  if (const auto part = value.find("part")) image.choice.part = part->text();
  if (const auto missing = value.find("missing")) {
    constexpr std::array<std::string_view, 3> kNames = {"error", "hold", "black"};
    image.missing = static_cast<Missing>(missing->choice(kNames));
    if (!is_sequence(image.pattern.text)) missing->refuse("allowed: with a sequence only, like bg.####.exr");
  }
  if (const auto space = value.find("space")) image.space = located_text(*space);
  if (const auto alpha = value.find("alpha")) {
    constexpr std::array<std::string_view, 3> kNames = {"associated", "straight", "none"};
    image.alpha = static_cast<AlphaKind>(alpha->choice(kNames));
  }
  return image;
}

LayerImage read_image_of(const Value& layer) {
  return read_image(
      layer.require("image", "the path of an image, or of a sequence, like plates/bg.####.exr"));
}

/// Nothing for infinity.
std::optional<Keyed<double>> read_distance(const Value& layer) {
  const auto distance = layer.find("distance");
  if (!distance || (!distance->is_map() && distance->text() == "infinity")) return std::nullopt;
  return read_keyed_positive(*distance, Dimension::Length);
}

/// The largest light, in radians: half of it has to stay well below a right angle.
constexpr double kLargestLight = kPi / 3;

/// A direction, or one with the diameter of a disc. Keys are of the direction alone.
void read_light(const Value& value, std::optional<Keyed<Direction>>& direction, Keyed<double>& diameter) {
  if (!value.is_map() || value.find("keys")) {
    direction = read_keyed_direction(value);
    return;
  }
  value.only_keys({"direction", "diameter"});
  direction = read_keyed_direction(value.require("direction", "[x, y, z], towards the light"));
  const auto given = value.find("diameter");
  if (!given) return;
  diameter = read_keyed(*given, [](const Value& v) {
    const double angle = v.positive(Dimension::Angle);
    if (angle > kLargestLight) v.refuse(in_quotes(v.text()) + " is too large; allowed: up to 60 deg");
    return angle;
  });
}

SphereLayer read_sphere(const Value& layer) {
  SphereLayer sphere;
  sphere.centre = read_keyed_vector(layer.require("centre", "[x, y, z], lengths"), Dimension::Length);
  sphere.radius = read_keyed_positive(layer.require("radius", "a length, like 6371 km"), Dimension::Length);
  if (const auto rotation = layer.find("rotation"))
    sphere.rotation = read_keyed_vector(*rotation, Dimension::Angle);
  if (const auto light = layer.find("light")) read_light(*light, sphere.light, sphere.light_diameter);
  if (const auto night = layer.find("night")) {
    if (!sphere.light) night->refuse("without light there is no night; needed: light, a direction");
    sphere.night = read_image(*night);
  }
  return sphere;
}

LayerIndex read_layer_name(const Value& value, const ShotNames& names, std::string_view allowed) {
  const auto found = std::find(names.layers.begin(), names.layers.end(), value.text());
  if (found == names.layers.end()) {
    value.refuse(fmt::format("{} is no layer of this shot; allowed: {}", in_quotes(value.text()), allowed));
  }
  return {static_cast<std::size_t>(found - names.layers.begin())};
}

void read_radii(const Value& layer, RingLayer& ring) {
  ring.inner = read_keyed(layer.require("inner", "a length"), [](const Value& v) {
    const double inner = v.quantity(Dimension::Length);
    if (inner < 0) v.refuse(in_quotes(v.text()) + " is negative; allowed: 0 or more");
    return inner;
  });
  const Value outer = layer.require("outer", "a length");
  ring.outer = read_keyed_positive(outer, Dimension::Length);
  for (const Keyed<double>* radii : {&ring.inner, &ring.outer}) {
    for (const double frame : radii->frames) {
      if (!(value_at(ring.inner, frame) < value_at(ring.outer, frame)))
        outer.refuse("has to be larger than inner");
    }
  }
}

RingLayer read_ring(const Value& layer, const ShotNames& names) {
  RingLayer ring;
  const Value centre = layer.require("centre", "[x, y, z], or the name of a sphere");
  if (centre.is_list() || centre.is_map()) {
    ring.centre = read_keyed_vector(centre, Dimension::Length);
  } else {
    ring.centre = read_layer_name(centre, names, "the name of a sphere, or [x, y, z]");
  }
  ring.normal = read_keyed_direction(layer.require("normal", "[x, y, z], the ring's axis"));
  read_radii(layer, ring);
  if (const auto shadow = layer.find("shadow_of"))
    ring.shadow_of = read_layer_name(*shadow, names, "the name of a sphere");
  if (const auto light = layer.find("light")) {
    if (!ring.shadow_of) light->refuse("has a meaning only together with shadow_of");
    read_light(*light, ring.light, ring.light_diameter);
  }
  return ring;
}

StarsLayer read_stars(const Value& layer) {
  StarsLayer stars;
  stars.catalogue = located_text(layer.require("catalogue", "the path of a star catalogue"));
  if (const auto exposure = layer.find("exposure"))
    stars.exposure = read_keyed_quantity(*exposure, Dimension::Number);
  if (const auto rotation = layer.find("rotation"))
    stars.rotation = read_keyed_vector(*rotation, Dimension::Angle);
  return stars;
}

void only_keys_of(LayerType type, const Value& layer) {
  switch (type) {
    case LayerType::Plate:
      return layer.only_keys({"name", "type", "image", "distance", "edge", "exposure"});
    case LayerType::LatLong:
      return layer.only_keys({"name", "type", "image", "exposure"});
    case LayerType::Sphere:
      return layer.only_keys(
          {"name", "type", "image", "centre", "radius", "rotation", "light", "night", "exposure"});
    case LayerType::Ring:
      return layer.only_keys(
          {"name", "type", "image", "centre", "normal", "inner", "outer", "shadow_of", "light", "exposure"});
    case LayerType::Stars:
      return layer.only_keys({"name", "type", "catalogue", "exposure", "rotation"});
    case LayerType::PovRay:
      return layer.only_keys({"name", "type", "scene", "as", "distance", "edge", "unit", "antialias", "width",
                              "timeout", "exposure"});
  }
}

}  // namespace

PlateLayer read_plate(const Value& layer) {
  PlateLayer plate;
  plate.distance = read_distance(layer);
  if (const auto edge = layer.find("edge")) {
    constexpr std::array<std::string_view, 4> kNames = {"black", "clamp", "mirror", "repeat"};
    plate.edge = static_cast<Edge>(edge->choice(kNames));
  }
  return plate;
}

namespace {

Layer read_kind(const Value& layer, const ShotNames& names) {
  if (!layer.is_map()) layer.refuse("needed: a map with the keys name, type, image, ...");
  const Value type_value =
      layer.require("type", fmt::format("one of {}", "plate, latlong, sphere, ring, stars, povray"));
  const auto type = static_cast<LayerType>(type_value.choice(kTypeNames));
  only_keys_of(type, layer);
  const std::string name = layer.require("name", "a name for this layer's files").name();
  const auto seen_as = [&](auto kind) { return Layer{name, read_image_of(layer), std::move(kind)}; };
  switch (type) {
    case LayerType::Plate:
      return seen_as(read_plate(layer));
    case LayerType::LatLong:
      return seen_as(LatLongLayer{});
    case LayerType::Sphere:
      return seen_as(read_sphere(layer));
    case LayerType::Ring:
      return seen_as(read_ring(layer, names));
    case LayerType::Stars:
      return Layer{name, {}, read_stars(layer)};
    case LayerType::PovRay:
      break;
  }
  return read_povray_layer(layer, name);
}

}  // namespace

Layer read_layer(const Value& layer, const ShotNames& names) {
  Layer result = read_kind(layer, names);
  const auto exposure = layer.find("exposure");
  if (exposure && !std::holds_alternative<StarsLayer>(result.kind))
    result.exposure = read_keyed_exposure(*exposure);
  return result;
}

namespace {

/// The sphere that a ring names.
const SphereLayer& named_sphere(const Value& name, LayerIndex layer, const std::vector<Layer>& layers) {
  const auto* sphere = std::get_if<SphereLayer>(&layers[layer.index].kind);
  if (!sphere) name.refuse(in_quotes(name.text()) + " is no sphere; allowed: the name of one");
  return *sphere;
}

void check_ring(const Value& item, const RingLayer& ring, const std::vector<Layer>& layers) {
  if (const auto* centre = std::get_if<LayerIndex>(&ring.centre)) {
    named_sphere(*item.find("centre"), *centre, layers);
  }
  if (!ring.shadow_of) return;
  const Value shadow = *item.find("shadow_of");
  if (!named_sphere(shadow, *ring.shadow_of, layers).light && !ring.light) {
    shadow.refuse(in_quotes(shadow.text()) +
                  " has no light to throw a shadow in; needed: light, there or of this ring");
  }
}

}  // namespace

void check_layers(const Value& layers, const Shot& shot) {
  const std::vector<Value> items = layers.items();
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    const auto& kind = shot.layers[k].kind;
    if (const auto* ring = std::get_if<RingLayer>(&kind)) check_ring(items[k], *ring, shot.layers);
    const auto* plate = std::get_if<PlateLayer>(&kind);
    if (plate && plate->distance && shot.camera.projection != Projection::Perspective) {
      items[k]
          .find("distance")
          ->refuse("a plate at a distance faces a perspective camera; allowed for this camera: infinity");
    }
  }
}

}  // namespace lensplane
