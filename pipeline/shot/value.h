// SPDX-License-Identifier: Apache-2.0
//
// A value of the shot file on its way from text to number: the YAML node together with the key that leads to
// it, so that every refusal says where, which key, what is wrong, and what is allowed.

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/shot/keyed.h"
#include "pipeline/shot/quantity.h"
#include "pipeline/shot/yaml_tree.h"

namespace lensplane {

/// All functions throw Failure (BadShot) when the value is not what is asked for.
class Value {
 public:
  Value(const YamlNode& node, std::string key) : node_(&node), key_(std::move(key)) {}

  const std::string& key() const { return key_; }
  const Location& location() const { return node_->location; }
  bool is_map() const { return node_->kind == YamlNode::Kind::Map; }
  bool is_list() const { return node_->kind == YamlNode::Kind::Sequence; }
  bool is_null() const { return node_->kind == YamlNode::Kind::Null; }

  [[noreturn]] void refuse(const std::string& what) const;

  // Maps
  /// Refuses unless this is a map with no keys but these.
  void only_keys(std::initializer_list<std::string_view> allowed) const;
  /// The value of a key of this map; nothing when it is absent or null.
  std::optional<Value> find(std::string_view name) const;
  /// The same, refused when there is none. `what` says what it is for: "full horizontal angle, in deg".
  Value require(std::string_view name, std::string_view what) const;
  /// A map's values, each with its key as text.
  std::vector<std::pair<YamlKey, Value>> entries() const;

  // Lists
  std::vector<Value> items() const;
  /// The same, refused unless there are `count`; `what` describes them.
  std::vector<Value> items(std::size_t count, std::string_view what) const;

  // Scalars
  /// Text that is not empty.
  std::string text() const;
  /// Text without folders or odd characters, fit to be part of a file name.
  std::string name() const;
  /// A whole number in [lowest, highest].
  int integer(int lowest, int highest) const;
  /// A finite quantity, in the units of `dimension`.
  double quantity(Dimension dimension) const;
  /// The same, refused unless greater than 0.
  double positive(Dimension dimension) const;
  /// The index of the text among `allowed`.
  std::size_t choice(std::span<const std::string_view> allowed) const;

  /// A list of three quantities.
  Vec3 vector(Dimension dimension) const;
  /// Where a vector of plain numbers points; its length says nothing.
  Direction direction() const;

 private:
  const YamlNode* node_;
  std::string key_;
};

/// The keyed form's frames, their values, and the interpolation; nothing when `value` is not keyed.
struct KeyFrames {
  std::vector<double> frames;
  std::vector<Value> values;
  Interpolation interpolation;
};
std::optional<KeyFrames> find_key_frames(const Value& value);

/// A value that is constant or keyed, `{keys: {FRAME: VALUE, ...}, interpolate: ...}`; `read` reads one
/// Value.
template <class Read>
auto read_keyed(const Value& value, Read read) -> Keyed<decltype(read(value))> {
  const auto keyed = find_key_frames(value);
  if (!keyed) return Keyed<decltype(read(value))>::constant(read(value));
  Keyed<decltype(read(value))> result{keyed->frames, {}, keyed->interpolation};
  for (const Value& at_key : keyed->values) result.values.push_back(read(at_key));
  return result;
}

Keyed<double> read_keyed_quantity(const Value& value, Dimension dimension);
Keyed<double> read_keyed_positive(const Value& value, Dimension dimension);
/// Stops: up to 32 either way.
Keyed<double> read_keyed_exposure(const Value& value);
Keyed<Vec3> read_keyed_vector(const Value& value, Dimension dimension);
Keyed<Direction> read_keyed_direction(const Value& value);

}  // namespace lensplane
