// SPDX-License-Identifier: Apache-2.0
//
// YAML as a plain tree in which every key and value knows where it stands.
//
// Built from yaml-cpp's events rather than its own nodes, because those neither report duplicate keys nor
// stop at hostile input: text that is huge, binary, nested without end, or that grows explosively through
// aliases.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/shot/location.h"

namespace lensplane {

struct YamlKey {
  std::string name;
  Location location;
};

struct YamlNode {
  enum class Kind { Null, Scalar, Sequence, Map };
  Kind kind = Kind::Null;
  Location location;
  std::string text;             // Scalar
  std::vector<YamlKey> keys;    // Map: the key of each item
  std::vector<YamlNode> items;  // Sequence, Map

  /// The value of a map's key, null when it has none.
  const YamlNode* find(const std::string& name) const;
  YamlNode* find(const std::string& name);
};

// Bounds that no shot comes near: a file of this size keys ten values on ten thousand frames.
inline constexpr std::size_t kMaxShotBytes = 4 << 20;
inline constexpr int kMaxYamlDepth = 32;
inline constexpr std::size_t kMaxYamlNodes = 500'000;  // aliases counted as what they stand for

/// Parses `text`, which stands in `file`. Throws Failure (BadShot), located.
YamlNode parse_yaml(const std::string& text, const std::string& file);

/// Reads and parses a shot file. Throws Failure: BadInput when there is no such file, else BadShot.
YamlNode read_yaml(const std::filesystem::path& path);

}  // namespace lensplane
