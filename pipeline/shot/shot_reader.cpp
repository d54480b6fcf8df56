// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/shot_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>

#include "pipeline/image/failure.h"
#include "pipeline/image/shipped.h"
#include "pipeline/shot/camera_file.h"
#include "pipeline/shot/camera_reader.h"
#include "pipeline/shot/frame_range.h"
#include "pipeline/shot/layer_files.h"
#include "pipeline/shot/layer_reader.h"
#include "pipeline/shot/output_reader.h"
#include "pipeline/shot/settings.h"
#include "pipeline/shot/trace_reader.h"

namespace lensplane {
namespace {

void read_version(const Value& root) {
  const Value version = root.require("lensplane", "the version of the format: lensplane: 1");
  if (version.text() != "1")
    version.refuse(in_quotes(version.text()) + " is a version this program does not read; allowed: 1");
}

std::vector<int> read_frames(const Value& value) {
  const ParsedFrames parsed = parse_frames(value.text());
  if (!parsed.error.empty()) value.refuse(parsed.error);
  return parsed.frames;
}

/// Frame rates as film exchanges them: 23.976 is 24000/1001.
Rational rational_from_rate(double rate) {
  if (rate == std::round(rate)) return {static_cast<int>(rate), 1};
  const double whole = std::ceil(rate);
  if (std::abs(whole * 1000.0 / 1001.0 - rate) < 0.005) return {static_cast<int>(whole) * 1000, 1001};
  const int thousandths = static_cast<int>(std::lround(rate * 1000.0));
  const int divisor = std::gcd(thousandths, 1000);
  return {thousandths / divisor, 1000 / divisor};
}

Rational read_fps(const Value& value) {
  const std::string text = value.text();
  const std::size_t slash = text.find('/');
  constexpr const char* kAllowed =
      "allowed: frames per second, like 24, 23.976 or 24000/1001, from 1/1000 to 100000";
  if (slash == std::string::npos) {
    const double rate = value.positive(Dimension::Number);
    if (rate < 1e-3 || rate > 1e5) value.refuse(in_quotes(text) + "; " + kAllowed);
    return rational_from_rate(rate);
  }
  Rational fps;
  const char* end = text.data() + text.size();
  const auto top = std::from_chars(text.data(), end, fps.numerator);
  const auto bottom = std::from_chars(text.data() + slash + 1, end, fps.denominator);
  const bool whole = top.ptr == text.data() + slash && bottom.ptr == end;
  const bool in_range =
      top.ec == std::errc() && bottom.ec == std::errc() && fps.numerator > 0 && fps.denominator > 0;
  const double rate = static_cast<double>(fps.numerator) / fps.denominator;
  if (!whole || !in_range || rate < 1e-3 || rate > 1e5) value.refuse(in_quotes(text) + "; " + kAllowed);
  return fps;
}

/// The names of a list's items, refused when one stands twice.
std::vector<std::string> read_names(const std::optional<Value>& list, std::set<std::string>& seen) {
  std::vector<std::string> names;
  if (!list) return names;
  for (const Value& item : list->items()) {
    if (!item.is_map()) item.refuse("needed: a map with the key name and others");
    const Value name = item.require("name", "a name");
    names.push_back(name.name());
    if (!seen.insert(names.back()).second)
      name.refuse(in_quotes(names.back()) + " is already the name of a lens or layer");
  }
  return names;
}

double geometric_mass(const Value& mass) {
  const double m = mass.quantity(Dimension::Mass);
  if (m < 0) mass.refuse(in_quotes(mass.text()) + " is negative; allowed: 0 or more");
  return m;
}

LensTrack read_lens(const Value& lens) {
  lens.only_keys({"name", "mass", "radius", "position"});
  LensTrack track;
  track.name = lens.require("name", "a name").name();
  const auto mass = lens.find("mass");
  const auto radius = lens.find("radius");
  if (mass && radius) radius->refuse("given together with mass; allowed: one of the two");
  if (radius) {
    track.m = read_keyed(*radius, [](const Value& v) {
      const double schwarzschild = v.quantity(Dimension::Length);
      if (schwarzschild < 0) v.refuse(in_quotes(v.text()) + " is negative; allowed: 0 or more");
      return schwarzschild / 2.0;
    });
  } else {
    track.m =
        read_keyed(lens.require("mass", "a mass, like 1.989e31 kg (or radius: its Schwarzschild radius)"),
                   geometric_mass);
  }
  track.position = read_keyed_vector(lens.require("position", "[x, y, z], lengths"), Dimension::Length);
  return track;
}

GradeSettings read_grade(const Value& grade) {
  grade.only_keys({"cdl", "id", "space"});
  const auto located_text = [](const Value& v) { return LocatedText{v.text(), v.location(), v.key()}; };
  const Value cdl = grade.require("cdl", "the path of a .cc, .ccc or .cdl");
  const std::string path = cdl.text();
  if (!path.ends_with(".cc") && !path.ends_with(".ccc") && !path.ends_with(".cdl"))
    cdl.refuse(in_quotes(path) + "; allowed: a .cc, .ccc or .cdl");
  GradeSettings settings{located_text(cdl), {}, std::nullopt};
  if (const auto id = grade.find("id")) settings.id = id->text();
  if (const auto space = grade.find("space")) settings.space = located_text(*space);
  return settings;
}

ColourSettings read_colour(const Value& root) {
  ColourSettings settings;
  for (LocatedText* name : {&settings.working, &settings.display, &settings.view})
    name->location = root.location();
  const auto colour = root.find("colour");
  if (!colour) return settings;
  colour->only_keys({"config", "working", "display", "view", "grade"});
  const auto read = [&colour](std::string_view key, LocatedText& name) {
    if (const auto value = colour->find(key)) name = {value->text(), value->location(), value->key()};
  };
  read("working", settings.working);
  read("display", settings.display);
  read("view", settings.view);
  if (colour->find("config")) read("config", settings.config.emplace());
  if (const auto grade = colour->find("grade")) settings.grade = read_grade(*grade);
  return settings;
}

bool is_power_of_4(int n) {
  while (n > 1 && n % 4 == 0) n /= 4;
  return n == 1;
}

SamplingSettings read_sampling(const Value& root) {
  SamplingSettings settings;
  const auto sampling = root.find("sampling");
  if (!sampling) return settings;
  sampling->only_keys({"max", "threshold"});
  if (const auto max = sampling->find("max")) {
    settings.max = max->integer(1, 64);
    if (!is_power_of_4(settings.max)) max->refuse(in_quotes(max->text()) + "; allowed: 1, 4, 16, 64");
  }
  if (const auto threshold = sampling->find("threshold")) {
    settings.threshold = threshold->positive(Dimension::Number);
    if (settings.threshold > 1.0)
      threshold->refuse(in_quotes(threshold->text()) + "; allowed: more than 0 and up to 1");
  }
  return settings;
}

OutputLayers output_layers(const ShotNames& names, const std::vector<Layer>& layers) {
  OutputLayers result{names.layers, std::vector<bool>(names.layers.size(), true)};
  for (const Layer& layer : layers) {
    const auto at = std::find(names.layers.begin(), names.layers.end(), layer.name) - names.layers.begin();
    result.have_maps[at] = !std::holds_alternative<StarsLayer>(layer.kind);
  }
  return result;
}

/// A camera can look at what has a centre; other layers are nowhere in particular.
void check_look_at(const Value& root, const Shot& shot) {
  const auto* look_at = std::get_if<LookAt>(&shot.camera.orientation);
  const auto* layer = look_at ? std::get_if<LayerIndex>(&look_at->target) : nullptr;
  if (!layer) return;
  const auto& kind = shot.layers[layer->index].kind;
  if (std::holds_alternative<SphereLayer>(kind) || std::holds_alternative<RingLayer>(kind)) return;
  const Value value = *root.find("camera")->find("look_at");
  value.refuse(in_quotes(value.text()) +
               " has no centre to look at; allowed: a lens, a sphere, a ring, or [x, y, z]");
}

}  // namespace

Shot shot_from_yaml(const YamlNode& tree) {
  const Value root(tree, "");
  root.only_keys({"lensplane", "shot", "frames", "fps", "camera", "lenses", "layers", "trace", "sampling",
                  "colour", "output"});
  read_version(root);
  NotYet not_yet;
  Shot shot;
  shot.name = root.require("shot", "the shot's name, which names every output file").name();
  shot.frames = read_frames(root.require("frames", "the frames, like 1001-1048"));
  if (const auto fps = root.find("fps")) shot.fps = read_fps(*fps);

  std::set<std::string> seen;
  const auto lenses = root.find("lenses");
  const Value layers = root.require("layers", "a list of what is seen");
  const ShotNames names{read_names(lenses, seen), read_names(layers, seen)};
  if (names.layers.empty()) layers.refuse("an empty list; needed: at least one layer");
  if (lenses) {
    for (const Value& lens : lenses->items()) shot.lenses.push_back(read_lens(lens));
  }
  for (const Value& item : layers.items()) shot.layers.push_back(read_layer(item, names));
  shot.camera = read_camera(root.require("camera", "a map with resolution, fov, ..."), names);
  shot.trace = read_trace(root.find("trace"), shot.camera.projection);
  shot.sampling = read_sampling(root);
  shot.colour = read_colour(root);
  shot.output = read_output(root.find("output"), shot.name, output_layers(names, shot.layers), not_yet);
  not_yet.throw_first();
  check_look_at(root, shot);
  check_layers(layers, shot);
  return shot;
}

Shot read_shot(const std::filesystem::path& path, const std::vector<std::string>& settings) {
  YamlNode root = read_yaml(path);
  for (const std::string& setting : settings) apply_setting(setting, root);
  Shot shot = shot_from_yaml(root);
  shot.file = path.string();

  const std::filesystem::path folder = path.parent_path();
  const auto beside_shot = [&folder](const std::string& file) {
    return (folder / file).lexically_normal().string();
  };
  for (Layer& layer : shot.layers) {
    for (LocatedText* file : files_of(layer)) {
      if (!file->text.starts_with(kShippedPrefix)) file->text = beside_shot(file->text);
    }
  }
  if (shot.colour.grade) shot.colour.grade->cdl.text = beside_shot(shot.colour.grade->cdl.text);
  if (shot.colour.config) shot.colour.config->text = beside_shot(shot.colour.config->text);
  shot.output.directory = beside_shot(shot.output.directory.string());
  put_plates(shot);
  if (shot.camera.from && !shot.camera.from->is_plate)
    shot.camera.from->path.text = beside_shot(shot.camera.from->path.text);
  read_camera_file(shot);
  return shot;
}

}  // namespace lensplane
