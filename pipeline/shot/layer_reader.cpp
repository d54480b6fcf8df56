// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/layer_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lensplane {
namespace {

enum class LayerType { Plate, LatLong, Sphere, Ring, Stars, PovRay };
constexpr std::array<std::string_view, 6> kTypeNames = {"plate", "latlong", "sphere",
                                                        "ring",  "stars",   "povray"};

LayerImage read_image(const Value& layer) {
  const Value value =
      layer.require("image", "the path of an image, or of a sequence, like plates/bg.####.exr");
  const auto located_text = [](const Value& v) { return LocatedText{v.text(), v.location(), v.key()}; };
  if (!value.is_map()) return {located_text(value), std::nullopt, std::nullopt};
  value.only_keys({"file", "space", "alpha"});
  LayerImage image{located_text(value.require("file", "the path of an image")), std::nullopt, std::nullopt};
  if (const auto space = value.find("space")) image.space = located_text(*space);
  if (const auto alpha = value.find("alpha")) {
    constexpr std::array<std::string_view, 3> kNames = {"associated", "straight", "none"};
    image.alpha = static_cast<AlphaKind>(alpha->choice(kNames));
  }
  return image;
}

/// A plate's or a POV-Ray scene's `distance`: only infinity is there yet.
void read_distance(const Value& layer, NotYet& not_yet) {
  const auto distance = layer.find("distance");
  if (!distance || (!distance->is_map() && distance->text() == "infinity")) return;
  read_keyed_positive(*distance, Dimension::Length);
  not_yet.add(*distance, "a plate at a finite distance; write infinity");
}

PlateLayer read_plate(const Value& layer, NotYet& not_yet) {
  PlateLayer plate;
  read_distance(layer, not_yet);
  if (const auto edge = layer.find("edge")) {
    constexpr std::array<std::string_view, 4> kNames = {"black", "clamp", "mirror", "repeat"};
    plate.edge = static_cast<Edge>(edge->choice(kNames));
  }
  return plate;
}

SphereLayer read_sphere(const Value& layer) {
  SphereLayer sphere;
  sphere.centre = read_keyed_vector(layer.require("centre", "[x, y, z], lengths"), Dimension::Length);
  sphere.radius = read_keyed_positive(layer.require("radius", "a length, like 6371 km"), Dimension::Length);
  if (const auto rotation = layer.find("rotation"))
    sphere.rotation = read_keyed_vector(*rotation, Dimension::Angle);
  if (const auto light = layer.find("light")) sphere.light = read_keyed_direction(*light);
  return sphere;
}

void check_ring(const Value& layer, const ShotNames& names) {
  const Value centre = layer.require("centre", "[x, y, z], or the name of a layer");
  if (centre.is_list() || centre.is_map()) {
    read_keyed_vector(centre, Dimension::Length);
  } else if (std::find(names.layers.begin(), names.layers.end(), centre.text()) == names.layers.end()) {
    centre.refuse(in_quotes(centre.text()) +
                  " is no layer of this shot; allowed: the name of one, or [x, y, z]");
  }
  read_keyed_direction(layer.require("normal", "[x, y, z], the ring's axis"));
  const Keyed<double> inner = read_keyed_positive(layer.require("inner", "a length"), Dimension::Length);
  const Value outer_value = layer.require("outer", "a length");
  const Keyed<double> outer = read_keyed_positive(outer_value, Dimension::Length);
  for (const Keyed<double>* radii : {&inner, &outer}) {
    for (const double frame : radii->frames) {
      if (!(value_at(inner, frame) < value_at(outer, frame)))
        outer_value.refuse("has to be larger than inner");
    }
  }
}

void check_stars(const Value& layer) {
  layer.require("catalogue", "the path of a star catalogue").text();
  if (const auto exposure = layer.find("exposure")) read_keyed_quantity(*exposure, Dimension::Number);
}

void check_povray(const Value& layer) {
  layer.require("scene", "the path of a .pov file").text();
  if (const auto as = layer.find("as")) {
    constexpr std::array<std::string_view, 2> kNames = {"plate", "latlong"};
    as->choice(kNames);
  }
  if (const auto distance = layer.find("distance");
      distance && (distance->is_map() || distance->text() != "infinity")) {
    read_keyed_positive(*distance, Dimension::Length);
  }
}

void only_keys_of(LayerType type, const Value& layer) {
  switch (type) {
    case LayerType::Plate:
      return layer.only_keys({"name", "type", "image", "distance", "edge"});
    case LayerType::LatLong:
      return layer.only_keys({"name", "type", "image"});
    case LayerType::Sphere:
      return layer.only_keys({"name", "type", "image", "centre", "radius", "rotation", "light"});
    case LayerType::Ring:
      return layer.only_keys({"name", "type", "image", "centre", "normal", "inner", "outer"});
    case LayerType::Stars:
      return layer.only_keys({"name", "type", "catalogue", "exposure"});
    case LayerType::PovRay:
      return layer.only_keys({"name", "type", "scene", "as", "distance"});
  }
}

}  // namespace

std::optional<Layer> read_layer(const Value& layer, const ShotNames& names, NotYet& not_yet) {
  if (!layer.is_map()) layer.refuse("needed: a map with the keys name, type, image, ...");
  const Value type_value =
      layer.require("type", fmt::format("one of {}", "plate, latlong, sphere, ring, stars, povray"));
  const auto type = static_cast<LayerType>(type_value.choice(kTypeNames));
  only_keys_of(type, layer);
  const std::string name = layer.require("name", "a name for this layer's files").name();
  switch (type) {
    case LayerType::Plate:
      return Layer{name, read_image(layer), read_plate(layer, not_yet)};
    case LayerType::LatLong:
      return Layer{name, read_image(layer), LatLongLayer{}};
    case LayerType::Sphere:
      return Layer{name, read_image(layer), read_sphere(layer)};
    case LayerType::Ring:
      read_image(layer);
      check_ring(layer, names);
      break;
    case LayerType::Stars:
      check_stars(layer);
      break;
    case LayerType::PovRay:
      check_povray(layer);
      break;
  }
  not_yet.add(type_value, type_value.text());
  return std::nullopt;
}

}  // namespace lensplane
