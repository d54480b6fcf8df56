// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/value.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace lensplane {
namespace {

std::string_view noun_of(YamlNode::Kind kind) {
  switch (kind) {
    case YamlNode::Kind::Null:
      return "nothing";
    case YamlNode::Kind::Scalar:
      return "a plain value";
    case YamlNode::Kind::Sequence:
      return "a list";
    case YamlNode::Kind::Map:
      return "a map of keys";
  }
  return {};
}

std::string join_key(const std::string& parent, std::string_view name) {
  return parent.empty() ? std::string(name) : fmt::format("{}.{}", parent, name);
}

}  // namespace

void Value::refuse(const std::string& what) const {
  lensplane::refuse(location(), key_, what);
}

void Value::only_keys(std::initializer_list<std::string_view> allowed) const {
  if (!is_map())
    refuse(
        fmt::format("{} where a map is needed, with the keys {}", noun_of(node_->kind), comma_list(allowed)));
  for (const YamlKey& key : node_->keys) {
    if (std::find(allowed.begin(), allowed.end(), key.name) != allowed.end()) continue;
    lensplane::refuse(key.location, join_key(key_, key.name),
                      fmt::format("unknown key; allowed: {}", comma_list(allowed)));
  }
}

std::optional<Value> Value::find(std::string_view name) const {
  const YamlNode* found = node_->find(std::string(name));
  if (!found || found->kind == YamlNode::Kind::Null) return std::nullopt;
  return Value(*found, join_key(key_, name));
}

Value Value::require(std::string_view name, std::string_view what) const {
  const auto found = find(name);
  if (!found) lensplane::refuse(location(), join_key(key_, name), fmt::format("missing; needed: {}", what));
  return *found;
}

std::vector<std::pair<YamlKey, Value>> Value::entries() const {
  std::vector<std::pair<YamlKey, Value>> entries;
  for (std::size_t i = 0; i < node_->keys.size(); ++i) {
    entries.emplace_back(node_->keys[i], Value(node_->items[i], join_key(key_, node_->keys[i].name)));
  }
  return entries;
}

std::vector<Value> Value::items() const {
  if (!is_list()) refuse(fmt::format("{} where a list is needed", noun_of(node_->kind)));
  std::vector<Value> values;
  for (std::size_t i = 0; i < node_->items.size(); ++i) {
    // Lenses and layers are known by their names.
    const YamlNode* name = node_->items[i].find("name");
    const bool named = name && name->kind == YamlNode::Kind::Scalar;
    values.emplace_back(node_->items[i],
                        join_key(key_, named ? name->text.substr(0, 60) : std::to_string(i)));
  }
  return values;
}

std::vector<Value> Value::items(std::size_t count, std::string_view what) const {
  if (!is_list() || node_->items.size() != count) refuse(fmt::format("needed: {}", what));
  return items();
}

std::string Value::text() const {
  if (node_->kind != YamlNode::Kind::Scalar)
    refuse(fmt::format("{} where text is needed", noun_of(node_->kind)));
  if (node_->text.empty()) refuse("empty; text is needed");
  return node_->text;
}

std::string Value::name() const {
  const std::string name = text();
  const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (name.size() > 100 || !std::all_of(name.begin(), name.end(), fits)) {
    refuse(in_quotes(name) + " cannot be part of a file name; allowed: up to 100 letters, digits, _ and -");
  }
  return name;
}

int Value::integer(int lowest, int highest) const {
  const std::string digits = text();
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || number < lowest || number > highest) {
    refuse(fmt::format("{}; allowed: a whole number from {} to {}", in_quotes(digits), lowest, highest));
  }
  return number;
}

double Value::quantity(Dimension dimension) const {
  if (node_->kind != YamlNode::Kind::Scalar) {
    const std::string units = units_of(dimension);
    refuse(fmt::format("{} where {} is needed{}{}", noun_of(node_->kind), lensplane::noun_of(dimension),
                       units.empty() ? "" : ", in ", units));
  }
  const ParsedQuantity parsed = parse_quantity(node_->text, dimension);
  if (!parsed.error.empty()) refuse(parsed.error);
  return parsed.value;
}

double Value::positive(Dimension dimension) const {
  const double value = quantity(dimension);
  if (!(value > 0)) refuse(fmt::format("{} is not greater than 0", in_quotes(node_->text)));
  return value;
}

std::size_t Value::choice(std::span<const std::string_view> allowed) const {
  const std::string chosen = text();
  const auto found = std::find(allowed.begin(), allowed.end(), chosen);
  if (found == allowed.end()) refuse(fmt::format("{}; allowed: {}", in_quotes(chosen), comma_list(allowed)));
  return static_cast<std::size_t>(found - allowed.begin());
}

Vec3 Value::vector(Dimension dimension) const {
  const std::string unit = units_of(dimension).substr(0, units_of(dimension).find(','));
  const auto xyz =
      items(3, fmt::format("a list of three, [x, y, z], each {}{}{}", lensplane::noun_of(dimension),
                           unit.empty() ? "" : ", like 1 ", unit));
  return {xyz[0].quantity(dimension), xyz[1].quantity(dimension), xyz[2].quantity(dimension)};
}

Direction Value::direction() const {
  const Vec3 v = vector(Dimension::Number);
  const double longest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (longest == 0) refuse("[0, 0, 0] points nowhere; allowed: a vector that is not null");
  return {(v / longest).normalized()};
}

std::optional<KeyFrames> find_key_frames(const Value& value) {
  if (!value.is_map()) return std::nullopt;
  value.only_keys({"keys", "interpolate"});
  const Value keys = value.require("keys", "a map from frames to values");
  if (!keys.is_map()) keys.refuse("needed: a map from frames to values, like {1001: ..., 1048: ...}");
  KeyFrames result{{}, {}, Interpolation::Linear};
  for (const auto& [key, at_key] : keys.entries()) {
    const ParsedQuantity frame = parse_quantity(key.name, Dimension::Number);
    if (!frame.error.empty()) refuse(key.location, keys.key(), "the frame " + frame.error);
    if (!result.frames.empty() && !(frame.value > result.frames.back())) {
      refuse(key.location, at_key.key(),
             fmt::format("frame {} does not come after frame {}", key.name, result.frames.back()));
    }
    result.frames.push_back(frame.value);
    result.values.push_back(at_key);
  }
  if (result.frames.empty()) keys.refuse("no keys; needed: at least one frame and its value");
  if (const auto interpolate = value.find("interpolate")) {
    constexpr std::array<std::string_view, 3> kNames = {"linear", "smooth", "step"};
    result.interpolation = static_cast<Interpolation>(interpolate->choice(kNames));
  }
  return result;
}

Keyed<double> read_keyed_quantity(const Value& value, Dimension dimension) {
  return read_keyed(value, [dimension](const Value& v) { return v.quantity(dimension); });
}

Keyed<double> read_keyed_positive(const Value& value, Dimension dimension) {
  return read_keyed(value, [dimension](const Value& v) { return v.positive(dimension); });
}

Keyed<double> read_keyed_exposure(const Value& value) {
  constexpr double kMost = 32;
  return read_keyed(value, [](const Value& v) {
    const double stops = v.quantity(Dimension::Number);
    if (std::abs(stops) > kMost) v.refuse(in_quotes(v.text()) + "; allowed: from -32 to 32 stops");
    return stops;
  });
}

Keyed<Vec3> read_keyed_vector(const Value& value, Dimension dimension) {
  return read_keyed(value, [dimension](const Value& v) { return v.vector(dimension); });
}

Keyed<Direction> read_keyed_direction(const Value& value) {
  return read_keyed(value, [](const Value& v) { return v.direction(); });
}

}  // namespace lensplane
