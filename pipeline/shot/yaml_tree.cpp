// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/yaml_tree.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "pipeline/image/failure.h"

namespace lensplane {
namespace {

/// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::shared_ptr<const std::string> file) : file_(std::move(file)) {}

  YamlNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add({.kind = YamlNode::Kind::Null, .location = at(mark), .text = {}, .keys = {}, .items = {}}, anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_tag(mark, tag);
    add({.kind = YamlNode::Kind::Scalar, .location = at(mark), .text = value, .keys = {}, .items = {}},
        anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) refuse(at(mark), "", "an alias inside of what it stands for");
    count_ += found->second.second;
    refuse_too_many(at(mark));
    count_ -= weight_of(found->second.first.text);  // add() counts the root of the copy
    add(found->second.first, 0);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::Sequence, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::Map, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct OpenNode {
    YamlNode node;
    YAML::anchor_t anchor;
    std::size_t count_before;
    std::set<std::string> names = {};
  };

  Location at(const YAML::Mark& mark) const { return {file_, mark.line + 1, mark.column + 1}; }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!") {
      refuse(at(mark), "", "the tag " + tag + " is not allowed; shot files have plain values only");
    }
  }

  void refuse_too_many(const Location& location) const {
    if (count_ > kMaxYamlNodes) {
      refuse(location, "",
             fmt::format("more than {} values, aliases counted as what they stand for", kMaxYamlNodes));
    }
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    refuse_tag(mark, tag);
    if (open_.size() >= static_cast<std::size_t>(kMaxYamlDepth)) {
      refuse(at(mark), "", fmt::format("nested more than {} levels deep", kMaxYamlDepth));
    }
    if (awaits_key()) refuse(at(mark), "", "a key has to be plain text, not a list or a map");
    open_.push_back(
        {{.kind = kind, .location = at(mark), .text = {}, .keys = {}, .items = {}}, anchor, count_});
  }

  void close() {
    OpenNode done = std::move(open_.back());
    open_.pop_back();
    add(std::move(done.node), done.anchor, done.count_before);
  }

  /// What a value counts for: one, and more for long text.
  static std::size_t weight_of(const std::string& text) { return 1 + text.size() / 128; }

  bool awaits_key() const {
    return !open_.empty() && open_.back().node.kind == YamlNode::Kind::Map &&
           open_.back().node.keys.size() == open_.back().node.items.size();
  }

  void add(YamlNode node, YAML::anchor_t anchor) { add(std::move(node), anchor, count_); }

  void add(YamlNode node, YAML::anchor_t anchor, std::size_t count_before) {
    count_ += weight_of(node.text);
    if (anchor != 0) {
      const std::size_t weight = count_ - count_before;
      count_ += weight;  // the copy that aliases will stand for
      anchors_[anchor] = {node, weight};
    }
    refuse_too_many(node.location);
    if (open_.empty()) {
      root_ = std::move(node);
    } else if (awaits_key()) {
      add_key(node);
    } else {
      open_.back().node.items.push_back(std::move(node));
    }
  }

  void add_key(const YamlNode& key) {
    if (key.kind != YamlNode::Kind::Scalar) refuse(key.location, "", "a key has to be plain text");
    if (!open_.back().names.insert(key.text).second)
      refuse(key.location, key.text, "this key stands here twice");
    open_.back().node.keys.push_back({key.text, key.location});
  }

  std::shared_ptr<const std::string> file_;
  std::vector<OpenNode> open_;
  std::map<YAML::anchor_t, std::pair<YamlNode, std::size_t>> anchors_;
  std::size_t count_ = 0;
  YamlNode root_;
};

/// Where the byte at `offset` stands in the text.
Location locate(const std::string& text, std::size_t offset, const std::string& file) {
  Location location{std::make_shared<const std::string>(file), 1, 1};
  for (std::size_t i = 0; i < offset; ++i) {
    ++location.column;
    if (text[i] == '\n') location.line += 1, location.column = 1;
  }
  return location;
}

/// Length of the UTF-8 sequence that starts at text[i] (overlong forms are let through), 0 when there is
/// none.
std::size_t utf8_length(const std::string& text, std::size_t i) {
  const auto byte = [&text](std::size_t at) { return static_cast<unsigned char>(text[at]); };
  const unsigned char first = byte(i);
  const std::size_t length = first < 0x80       ? 1
                             : first >> 5 == 6  ? 2
                             : first >> 4 == 14 ? 3
                             : first >> 3 == 30 ? 4
                                                : 0;
  if (i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if (byte(i + k) >> 6 != 2) return 0;
  }
  return length;
}

void refuse_binary(const std::string& text, const std::string& file) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool control = (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7f;
    if (length == 0 || control) {
      refuse(locate(text, i, file), "", fmt::format("byte 0x{:02x}: a shot is plain UTF-8 text", byte));
    }
    i += length;
  }
}

}  // namespace

const YamlNode* YamlNode::find(const std::string& name) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].name == name) return &items[i];
  }
  return nullptr;
}

YamlNode* YamlNode::find(const std::string& name) {
  return const_cast<YamlNode*>(std::as_const(*this).find(name));
}

YamlNode parse_yaml(const std::string& text, const std::string& file) {
  refuse_binary(text, file);
  const auto name = std::make_shared<const std::string>(file);
  TreeBuilder builder(name);
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) refuse({name, 1, 1}, "", "the file is empty");
    YamlNode root = builder.take_root();
    if (parser.HandleNextDocument(builder)) {
      refuse(builder.take_root().location, "", "a second YAML document; a shot is one");
    }
    return root;
  } catch (const YAML::Exception& error) {
    refuse({name, error.mark.line + 1, error.mark.column + 1}, "", "not valid YAML: " + error.msg);
  }
}

YamlNode read_yaml(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw Failure(ExitCode::BadInput, file + ": no such shot file");
  if (!std::filesystem::is_regular_file(status)) throw Failure(ExitCode::BadInput, file + ": is not a file");
  if (std::filesystem::file_size(path, error) > kMaxShotBytes) {
    refuse({std::make_shared<const std::string>(file), 1, 1}, "",
           fmt::format("the file is larger than {} MiB; is it a shot?", kMaxShotBytes >> 20));
  }
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) throw Failure(ExitCode::BadInput, file + ": cannot be read");
  return parse_yaml(text, file);
}

}  // namespace lensplane
