// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/shot_reader.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>

#include "pipeline/image/failure.h"
#include "pipeline/image/shipped.h"
#include "pipeline/shot/camera_reader.h"
#include "pipeline/shot/frame_range.h"
#include "pipeline/shot/layer_reader.h"
#include "pipeline/shot/settings.h"

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

Method read_method(const std::optional<Value>& trace, const Value& root, NotYet& not_yet) {
  constexpr std::array<std::string_view, 4> kNames = {"kishi", "shinotsuka-makino", "planes", "geodesic"};
  constexpr const char* kHint = "; write trace: {method: shinotsuka-makino} or {method: kishi}";
  const auto value = trace ? trace->find("method") : std::nullopt;
  if (!value) {
    not_yet.add(trace ? *trace : root,
                std::string("trace.method: planes, which stands for no trace.method") + kHint);
    return Method::ShinotsukaMakino;
  }
  const std::string_view name = kNames[value->choice(kNames)];
  const auto method = method_named(name);
  if (!method) not_yet.add(*value, std::string(name) + kHint);
  return method.value_or(Method::ShinotsukaMakino);
}

Method read_trace(const Value& root, NotYet& not_yet) {
  const auto trace = root.find("trace");
  if (trace) {
    trace->only_keys({"method", "law", "tolerance", "effects"});
    constexpr std::array<std::string_view, 4> kLaws = {"weak", "second-order", "exact", "auto"};
    const auto law = trace->find("law");
    const std::size_t chosen = law ? law->choice(kLaws) : 0;
    if (chosen == 1 || chosen == 2) not_yet.add(*law, law->text() + "; write weak or auto");
    if (const auto tolerance = trace->find("tolerance")) read_keyed_positive(*tolerance, Dimension::Pixels);
    if (const auto effects = trace->find("effects")) {
      effects->only_keys({"finite_distance"});
      constexpr std::array<std::string_view, 3> kStates = {"on", "off", "auto"};
      const auto state = effects->find("finite_distance");
      if (state && state->choice(kStates) == 0) not_yet.add(*state, "on; write off or auto");
    }
  }
  return read_method(trace, root, not_yet);
}

ColourSettings read_colour(const Value& root) {
  ColourSettings settings;
  for (LocatedText* name : {&settings.working, &settings.display, &settings.view})
    name->location = root.location();
  const auto colour = root.find("colour");
  if (!colour) return settings;
  colour->only_keys({"config", "working", "display", "view"});
  const auto read = [&colour](std::string_view key, LocatedText& name) {
    if (const auto value = colour->find(key)) name = {value->text(), value->location(), value->key()};
  };
  read("working", settings.working);
  read("display", settings.display);
  read("view", settings.view);
  if (colour->find("config")) read("config", settings.config.emplace());
  return settings;
}

ExrFormat read_format(const Value& image) {
  image.only_keys({"type", "compression"});
  ExrFormat format;
  if (const auto type = image.find("type")) {
    constexpr std::array<std::string_view, 2> kNames = {"half", "float"};
    format.type = static_cast<PixelType>(type->choice(kNames));
  }
  if (const auto compression = image.find("compression")) {
    constexpr std::array<std::string_view, 10> kNames = {"none",  "rle", "zips", "zip",  "piz",
                                                         "pxr24", "b44", "b44a", "dwaa", "dwab"};
    format.compression = static_cast<ExrCompression>(compression->choice(kNames));
  }
  return format;
}

std::vector<bool> read_maps(const Value& maps, const std::vector<std::string>& layers) {
  if (!maps.is_list()) {
    constexpr std::array<std::string_view, 2> kNames = {"all", "none"};
    return std::vector<bool>(layers.size(), maps.choice(kNames) == 0);
  }
  std::vector<bool> chosen(layers.size(), false);
  const std::vector<std::string_view> allowed(layers.begin(), layers.end());
  for (const Value& item : maps.items()) chosen[item.choice(allowed)] = true;
  return chosen;
}

void check_data(const Value& data, NotYet& not_yet) {
  constexpr std::array<std::string_view, 7> kPasses = {"jacobian", "magnification", "delay", "direction",
                                                       "shadow",   "bends",         "depth"};
  for (const Value& pass : data.items()) {
    pass.choice(kPasses);
    not_yet.add(pass, pass.text());
  }
}

OutputSettings read_output(const Value& root, const Shot& shot, const std::vector<std::string>& layers,
                           NotYet& not_yet) {
  OutputSettings settings;
  settings.directory = "renders/" + shot.name;
  settings.maps.assign(layers.size(), true);
  const auto output = root.find("output");
  if (!output) return settings;
  output->only_keys({"directory", "image", "maps", "data", "review", "movie", "locator"});
  if (const auto directory = output->find("directory")) settings.directory = directory->text();
  if (const auto image = output->find("image")) settings.image = read_format(*image);
  if (const auto maps = output->find("maps")) settings.maps = read_maps(*maps, layers);
  if (const auto data = output->find("data")) check_data(*data, not_yet);
  if (const auto review = output->find("review")) {
    constexpr std::array<std::string_view, 2> kNames = {"none", "png"};
    settings.review = review->choice(kNames) == 1;
  }
  if (const auto locator = output->find("locator")) {
    constexpr std::array<std::string_view, 2> kNames = {"none", "beside"};
    settings.locator = static_cast<Locator>(locator->choice(kNames));
  }
  if (const auto movie = output->find("movie")) {
    constexpr std::array<std::string_view, 3> kNames = {"none", "mp4", "prores"};
    if (movie->choice(kNames) != 0) not_yet.add(*movie, movie->text() + "; write none");
  }
  return settings;
}

/// A camera can look at a lens or at a sphere; other layers are nowhere in particular.
void check_look_at(const Value& root, const Shot& shot) {
  const auto* look_at = std::get_if<LookAt>(&shot.camera.orientation);
  const auto* layer = look_at ? std::get_if<LayerIndex>(&look_at->target) : nullptr;
  if (!layer || std::holds_alternative<SphereLayer>(shot.layers[layer->index].kind)) return;
  const Value value = *root.find("camera")->find("look_at");
  value.refuse(in_quotes(value.text()) +
               " has no centre to look at; allowed: a lens, a sphere, or [x, y, z]");
}

}  // namespace

Shot shot_from_yaml(const YamlNode& tree) {
  const Value root(tree, "");
  root.only_keys(
      {"lensplane", "shot", "frames", "fps", "camera", "lenses", "layers", "trace", "colour", "output"});
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
  for (const Value& item : layers.items()) {
    if (auto layer = read_layer(item, names, not_yet)) shot.layers.push_back(std::move(*layer));
  }
  shot.camera = read_camera(root.require("camera", "a map with resolution, fov, ..."), names, not_yet);
  shot.method = read_trace(root, not_yet);
  shot.colour = read_colour(root);
  shot.output = read_output(root, shot, names.layers, not_yet);
  not_yet.throw_first();
  check_look_at(root, shot);
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
    std::string& pattern = layer.image.pattern.text;
    if (!pattern.starts_with(kShippedPrefix)) pattern = beside_shot(pattern);
  }
  if (shot.colour.config) shot.colour.config->text = beside_shot(shot.colour.config->text);
  shot.output.directory = beside_shot(shot.output.directory.string());
  return shot;
}

}  // namespace lensplane
