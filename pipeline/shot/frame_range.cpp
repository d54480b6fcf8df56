// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/frame_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "pipeline/shot/location.h"

namespace lensplane {
namespace {

/// Takes a whole number off the front of `text`.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  if (text.empty() || text.front() < '0' || text.front() > '9') return std::nullopt;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number > kMaxFrame) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, char wanted) {
  if (!text.starts_with(wanted)) return false;
  text.remove_prefix(1);
  return true;
}

/// Appends the frames of one part, "1001", "1001-1010" or "1001-1010x2"; returns what is wrong.
std::string append_part(std::string_view part, std::vector<int>& frames) {
  const std::string malformed =
      fmt::format("{} is not a range of frames; write 1001, 1001-1048, 1001-1100x2, or several with commas",
                  in_quotes(part));
  std::string_view rest = part;
  const auto first = take_number(rest);
  if (!first) return malformed;
  int last = *first;
  int step = 1;
  if (take(rest, '-')) {
    const auto end = take_number(rest);
    if (!end) return malformed;
    last = *end;
    if (take(rest, 'x')) {
      const auto stride = take_number(rest);
      if (!stride) return malformed;
      step = *stride;
    }
  }
  if (!rest.empty()) return malformed;
  if (last < *first)
    return fmt::format("{} ends before it starts; write {}-{}", in_quotes(part), last, *first);
  if (step == 0) return fmt::format("{} steps by 0; the step has to be 1 or more", in_quotes(part));
  if (static_cast<std::size_t>((last - *first) / step) + frames.size() >= kMaxFrames) {
    return fmt::format("{} makes more than {} frames", in_quotes(part), kMaxFrames);
  }
  for (int frame = *first; frame <= last; frame += step) frames.push_back(frame);
  return {};
}

}  // namespace

ParsedFrames parse_frames(std::string_view text) {
  std::string without_spaces(text);
  std::erase(without_spaces, ' ');
  std::string_view rest = without_spaces;
  ParsedFrames parsed;
  for (bool more = true; more;) {
    const std::string_view part = rest.substr(0, rest.find(','));
    rest.remove_prefix(part.size());
    more = take(rest, ',');
    parsed.error = append_part(part, parsed.frames);
    if (!parsed.error.empty()) return {{}, parsed.error};
  }
  std::sort(parsed.frames.begin(), parsed.frames.end());
  parsed.frames.erase(std::unique(parsed.frames.begin(), parsed.frames.end()), parsed.frames.end());
  return parsed;
}

}  // namespace lensplane
