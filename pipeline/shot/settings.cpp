// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/settings.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "pipeline/image/failure.h"

namespace lensplane {
namespace {

[[noreturn]] void refuse(const std::string& setting, const std::string& what) {
  throw Failure(ExitCode::BadShot, fmt::format("--set {}: {}", in_quotes(setting), what));
}

/// The item of a list that `part` names, null when there is none.
YamlNode* find_item(YamlNode& list, const std::string& part) {
  for (YamlNode& item : list.items) {
    const YamlNode* name = item.find("name");
    if (name && name->text == part) return &item;
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool is_number = error == std::errc() && end == part.data() + part.size();
  return is_number && index < list.items.size() ? &list.items[index] : nullptr;
}

/// The place one step below `node`.
YamlNode& descend(YamlNode& node, const std::string& part, const Location& location,
                  const std::string& setting) {
  if (part.empty()) refuse(setting, "an empty key; write key.path=value, like camera.fov=2 deg");
  if (node.kind == YamlNode::Kind::Sequence) {
    YamlNode* item = find_item(node, part);
    if (!item)
      refuse(setting, fmt::format("{} is neither a name in this list nor a number in it", in_quotes(part)));
    return *item;
  }
  if (node.kind != YamlNode::Kind::Map) {
    node.kind = YamlNode::Kind::Map;
    node.text.clear();
    node.location = location;
  }
  if (YamlNode* found = node.find(part)) return *found;
  node.keys.push_back({part, location});
  node.items.push_back(
      {.kind = YamlNode::Kind::Null, .location = location, .text = {}, .keys = {}, .items = {}});
  return node.items.back();
}

}  // namespace

void apply_setting(const std::string& setting, YamlNode& root) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) refuse(setting, "no value; write key.path=value, like camera.fov=2 deg");
  const std::string path = setting.substr(0, equals);
  const std::string source = "--set " + path;
  const Location location{std::make_shared<const std::string>(source), 1, 1};
  const std::string text = setting.substr(equals + 1);
  const YamlNode value = parse_yaml(text.empty() ? "\"\"" : text, source);

  if (path.empty() || path.ends_with('.'))
    refuse(setting, "an empty key; write key.path=value, like camera.fov=2 deg");
  YamlNode* node = &root;
  std::istringstream parts(path);
  int depth = 0;
  for (std::string part; std::getline(parts, part, '.');) {
    if (++depth > kMaxYamlDepth) refuse(setting, fmt::format("more than {} levels deep", kMaxYamlDepth));
    node = &descend(*node, part, location, setting);
  }
  *node = value;
}

}  // namespace lensplane
