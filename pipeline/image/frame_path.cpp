// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/frame_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <regex>

namespace lensplane {
namespace {

struct Placeholder {
  std::size_t start;
  std::size_t length;
  int padding;
};

/// The placeholder in the file's own name; folders may be called as they like.
std::optional<Placeholder> find_placeholder(const std::string& pattern) {
  const std::size_t name = pattern.find_last_of('/') + 1;  // 0 when there is no folder
  const std::size_t last = pattern.find_last_of('#');
  if (last != std::string::npos && last >= name) {
    const std::size_t before = pattern.find_last_not_of('#', last);
    const std::size_t start = before == std::string::npos ? 0 : before + 1;
    return Placeholder{start, last + 1 - start, static_cast<int>(last + 1 - start)};
  }
  static const std::regex percent("%(0[1-9])?d");
  std::smatch match;
  const std::string file = pattern.substr(name);
  if (!std::regex_search(file, match, percent)) return std::nullopt;
  const int padding = match[1].matched ? std::stoi(match[1].str()) : 1;
  return Placeholder{name + static_cast<std::size_t>(match.position()),
                     static_cast<std::size_t>(match.length()), padding};
}

}  // namespace

bool is_sequence(const std::string& pattern) {
  return find_placeholder(pattern).has_value();
}

std::string path_of_frame(const std::string& pattern, int frame) {
  const auto placeholder = find_placeholder(pattern);
  if (!placeholder) return pattern;
  std::string path = pattern;
  path.replace(placeholder->start, placeholder->length, fmt::format("{:0{}d}", frame, placeholder->padding));
  return path;
}

std::vector<int> frames_on_disk(const std::string& pattern) {
  std::vector<int> frames;
  const auto placeholder = find_placeholder(pattern);
  if (!placeholder) return frames;
  const std::filesystem::path folder = std::filesystem::path(pattern).parent_path();
  const std::size_t start = placeholder->start - (pattern.find_last_of('/') + 1);
  std::error_code error;
  for (std::filesystem::directory_iterator file(folder.empty() ? "." : folder, error), end; file != end;
       file.increment(error)) {
    if (error) break;
    const std::string name = file->path().filename().string();
    if (name.size() <= start) continue;
    int frame = 0;
    const auto [stop, wrong] = std::from_chars(name.data() + start, name.data() + name.size(), frame);
    if (wrong == std::errc() && std::filesystem::path(path_of_frame(pattern, frame)).filename() == name)
      frames.push_back(frame);
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

}  // namespace lensplane
