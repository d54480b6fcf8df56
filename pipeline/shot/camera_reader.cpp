// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/camera_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "src/constants.h"

namespace lensplane {
namespace {

constexpr int kMaxResolution = 65536;
constexpr int kMaxOverscan = 16384;
constexpr int kMaxShutterSamples = 256;

constexpr std::array<std::string_view, 3> kProjectionNames = {"perspective", "latlong", "fisheye"};

Projection read_projection(const Value& camera) {
  const auto projection = camera.find("projection");
  return projection ? static_cast<Projection>(projection->choice(kProjectionNames)) : Projection::Perspective;
}

double read_fov(const Value& fov, Projection projection) {
  const double angle = fov.positive(Dimension::Angle);
  if (angle < kNarrowestFov)
    fov.refuse(in_quotes(fov.text()) + " is narrower than any picture; allowed: from 1e-15 rad");
  if (projection == Projection::Perspective && !(angle < kPi)) {
    fov.refuse(in_quotes(fov.text()) +
               "; allowed for a perspective camera: more than 0 deg and less than 180 deg");
  }
  // Conversion to radians may leave 360 deg a rounding above.
  if (projection == Projection::Fisheye && angle > 2.0 * kPi * (1.0 + 1e-12))
    fov.refuse(in_quotes(fov.text()) + "; allowed for a fisheye camera: more than 0 deg and up to 360 deg");
  return std::min(angle, 2.0 * kPi);
}

std::variant<Keyed<double>, FocalLength> read_perspective_fov(const Value& camera) {
  const auto fov = camera.find("fov");
  const auto focal_length = camera.find("focal_length");
  const auto film_width = camera.find("film_width");
  if (fov && focal_length) focal_length->refuse("given together with fov; allowed: one of the two");
  if (fov && film_width) film_width->refuse("given together with fov; allowed: with focal_length only");
  if (focal_length) {
    const Value width = camera.require("film_width", "the film's width for this focal_length, like 36 mm");
    return FocalLength{read_keyed_positive(*focal_length, Dimension::Length),
                       read_keyed_positive(width, Dimension::Length), focal_length->location()};
  }
  const Value needed =
      camera.require("fov", "the full horizontal angle, like 3 deg (or focal_length and film_width)");
  return read_keyed(needed, [](const Value& v) { return read_fov(v, Projection::Perspective); });
}

Keyed<double> read_fisheye_fov(const Value& camera) {
  for (const char* key : {"focal_length", "film_width"}) {
    if (const auto value = camera.find(key))
      value->refuse("given for a fisheye camera; allowed: with perspective only, write fov");
  }
  const Value needed = camera.require("fov", "the full angle across the circle, like 180 deg");
  return read_keyed(needed, [](const Value& v) { return read_fov(v, Projection::Fisheye); });
}

Keyed<double> whole_sphere(const Value& camera) {
  for (const char* key : {"fov", "focal_length", "film_width"}) {
    if (const auto value = camera.find(key))
      value->refuse("given for a latlong camera, which sees the whole sphere; allowed: with perspective" +
                    std::string(key == std::string_view("fov") ? " and fisheye only" : " only"));
  }
  return Keyed<double>::constant(2.0 * kPi);
}

std::variant<Keyed<double>, FocalLength> read_field_of_view(const Value& camera, Projection projection) {
  if (projection == Projection::LatLong) return whole_sphere(camera);
  if (projection == Projection::Fisheye) return read_fisheye_fov(camera);
  return read_perspective_fov(camera);
}

template <class Index>
std::optional<Index> find_name(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return Index{static_cast<std::size_t>(found - names.begin())};
}

LookAt read_look_at(const Value& value, const Value& camera, const ShotNames& names) {
  LookAt look_at{{}, Keyed<Direction>::constant({{0, 1, 0}}), value.location()};
  if (const auto up = camera.find("up")) look_at.up = read_keyed_direction(*up);
  if (value.is_list() || value.is_map()) {
    look_at.target = read_keyed_vector(value, Dimension::Length);
    return look_at;
  }
  const std::string name = value.text();
  const auto lens = find_name<LensIndex>(names.lenses, name);
  const auto layer = find_name<LayerIndex>(names.layers, name);
  if (lens) look_at.target = *lens;
  if (layer) look_at.target = *layer;
  if (!lens && !layer) {
    value.refuse(in_quotes(name) +
                 " is no lens or layer of this shot; allowed: one of their names, or [x, y, z]");
  }
  return look_at;
}

std::variant<Rotation, LookAt> read_orientation(const Value& camera, const ShotNames& names) {
  const auto look_at = camera.find("look_at");
  const auto rotation = camera.find("rotation");
  if (look_at && rotation) rotation->refuse("given together with look_at; allowed: one of the two");
  if (look_at) return read_look_at(*look_at, camera, names);
  if (const auto up = camera.find("up")) up->refuse("has a meaning only together with look_at");
  if (rotation) return Rotation{read_keyed_vector(*rotation, Dimension::Angle)};
  return Rotation{};
}

/// Nothing for auto.
std::optional<int> read_overscan(const Value& overscan) {
  if (overscan.text() == "auto") return std::nullopt;
  const int pixels = overscan.integer(0, kMaxOverscan);
  if (pixels % 2 != 0)
    overscan.refuse(fmt::format("{} is odd; allowed: an even number of pixels, or auto", pixels));
  return pixels;
}

/// By an angle of the whole turn that a frame takes, with the frame in the middle.
void read_shutter_angle(const Value& angle, Shutter& shutter) {
  const auto edge = [&angle](double side) {
    return read_keyed(angle, [side](const Value& v) {
      const double turn = v.positive(Dimension::Angle) / (2.0 * kPi);
      if (turn > 1.0 + 1e-12) v.refuse(in_quotes(v.text()) + "; allowed: more than 0 deg and up to 360 deg");
      return side * turn;
    });
  };
  shutter.open = edge(-0.5);
  shutter.close = edge(0.5);
}

void read_shutter_edges(const Value& value, Shutter& shutter) {
  const auto open = value.find("open"), close = value.find("close");
  constexpr double kHalfOfHalfAFrame = 0.25;
  if (!open && !close) {
    shutter.open = Keyed<double>::constant(-kHalfOfHalfAFrame);
    shutter.close = Keyed<double>::constant(kHalfOfHalfAFrame);
  }
  if (open) shutter.open = read_keyed_quantity(*open, Dimension::Number);
  if (close) shutter.close = read_keyed_quantity(*close, Dimension::Number);
  for (const Keyed<double>* keyed : {&shutter.open, &shutter.close}) {
    for (const double frame : keyed->frames) {
      if (value_at(shutter.close, frame) < value_at(shutter.open, frame))
        value.refuse("closes before it opens; allowed: open <= close");
    }
  }
}

Shutter read_shutter(const Value& value) {
  value.only_keys({"open", "close", "angle", "samples"});
  Shutter shutter;
  shutter.samples = std::nullopt;
  const auto angle = value.find("angle");
  for (const char* key : {"open", "close"}) {
    const auto edge = value.find(key);
    if (angle && edge) edge->refuse("given together with angle; allowed: one of the two");
  }
  angle ? read_shutter_angle(*angle, shutter) : read_shutter_edges(value, shutter);
  const auto samples = value.find("samples");
  if (samples && samples->text() != "auto") shutter.samples = samples->integer(1, kMaxShutterSamples);
  return shutter;
}

GlowTrack read_glow(const Value& glow) {
  glow.only_keys({"strength", "radius"});
  constexpr double kLargestRadius = 1;
  GlowTrack track;
  track.strength =
      read_keyed(glow.require("strength", "the share of the light, like 0.05"), [](const Value& v) {
        const double share = v.quantity(Dimension::Number);
        if (share < 0 || share > 1) v.refuse(in_quotes(v.text()) + "; allowed: from 0 to 1");
        return share;
      });
  track.radius =
      read_keyed(glow.require("radius", "a share of the frame's width, like 2 %"), [](const Value& v) {
        const double share = v.positive(Dimension::Share);
        if (share > kLargestRadius)
          v.refuse(in_quotes(v.text()) + "; allowed: more than 0 % and up to 100 %");
        return share;
      });
  return track;
}

CameraFile read_from(const Value& from, const Value& camera, Projection projection, const ShotNames& names) {
  if (projection != Projection::Perspective)
    from.refuse("given for a camera that is not perspective; allowed: with perspective only");
  for (const char* key : {"position", "look_at", "rotation", "up"}) {
    if (const auto value = camera.find(key))
      value->refuse("given together with from; allowed: one of the two");
  }
  CameraFile file;
  Value path = from;
  if (from.is_map()) {
    from.only_keys({"file", "plate", "unit"});
    const auto plate = from.find("plate");
    if (plate && from.find("file")) plate->refuse("given together with file; allowed: one of the two");
    path = plate ? *plate : from.require("file", "the path of a .chan file, or plate: a layer");
    if (plate) file.plate = find_name<LayerIndex>(names.layers, plate->text());
    if (plate && !file.plate)
      plate->refuse(in_quotes(plate->text()) + " is no layer of this shot; allowed: a plate");
    if (const auto unit = from.find("unit")) file.unit = unit->positive(Dimension::Length);
  }
  file.path = {path.text(), path.location(), path.key()};
  file.is_plate = file.plate || (!from.is_map() && path.text() == "plate");
  if (file.is_plate) file.path.text.clear();
  if (!file.is_plate && !path.text().ends_with(".chan"))
    path.refuse(in_quotes(path.text()) + "; allowed: the path of a .chan file, plate, or {plate: LAYER}");
  file.fov_is_given = camera.find("fov") || camera.find("focal_length");
  return file;
}

}  // namespace

CameraTrack read_camera(const Value& camera, const ShotNames& names) {
  camera.only_keys({"projection", "resolution", "fov", "focal_length", "film_width", "position", "look_at",
                    "rotation", "up", "overscan", "shutter", "from", "glow", "exposure"});
  CameraTrack track;
  track.projection = read_projection(camera);
  const auto size = camera.require("resolution", "[width, height] in pixels")
                        .items(2, "[width, height] in pixels, like [1920, 1080]");
  track.width = size[0].integer(1, kMaxResolution);
  track.height = size[1].integer(1, kMaxResolution);
  const auto from = camera.find("from");
  if (from) track.from = read_from(*from, camera, track.projection, names);
  if (!from || track.from->fov_is_given) track.fov = read_field_of_view(camera, track.projection);
  if (const auto position = camera.find("position"))
    track.position = read_keyed_vector(*position, Dimension::Length);
  track.orientation = read_orientation(camera, names);
  if (const auto overscan = camera.find("overscan")) track.overscan = read_overscan(*overscan);
  const double margin = 2.0 * track.overscan.value_or(0);
  const double pixels = (track.width + margin) * (track.height + margin);
  if (pixels > kMaxFilmPixels) {
    camera.find("resolution")
        ->refuse(fmt::format("more than {} million pixels with overscan", kMaxFilmPixels >> 20));
  }
  if (const auto shutter = camera.find("shutter")) track.shutter = read_shutter(*shutter);
  if (const auto exposure = camera.find("exposure")) track.exposure = read_keyed_exposure(*exposure);
  if (const auto glow = camera.find("glow")) track.glow = read_glow(*glow);
  return track;
}

}  // namespace lensplane
