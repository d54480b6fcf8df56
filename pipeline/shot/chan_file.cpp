// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/chan_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "pipeline/image/failure.h"
#include "pipeline/shot/location.h"
#include "pipeline/shot/quantity.h"

namespace lensplane {
namespace {

constexpr const char* kLine = "needed: frame tx ty tz rx ry rz, and vfov or not";

/// A line of a file, for errors.
struct Line {
  const std::filesystem::path& path;
  int number;

  [[noreturn]] void refuse(const std::string& what) const {
    throw Failure(ExitCode::BadInput, fmt::format("{}:{}: {}", path.string(), number, what));
  }
};

double read_number(const std::string& word, const Line& line) {
  double number = 0;
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(first, word.data() + word.size(), number);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  if (!whole || !(std::abs(number) <= kLargestQuantity))
    line.refuse(fmt::format("{} is no number; {}", in_quotes(word), kLine));
  return number;
}

/// Nothing of a line that says nothing.
std::optional<ChanKey> read_key(std::string text, const Line& line) {
  text.erase(std::min(text.find('#'), text.size()));
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) numbers.push_back(read_number(word, line));
  if (numbers.empty()) return std::nullopt;
  if (numbers.size() != 7 && numbers.size() != 8)
    line.refuse(fmt::format("{} numbers; {}", numbers.size(), kLine));
  ChanKey key{numbers[0], {numbers[1], numbers[2], numbers[3]}, {numbers[4], numbers[5], numbers[6]}, {}};
  if (numbers.size() == 7) return key;
  key.vertical_fov_deg = numbers[7];
  if (!(*key.vertical_fov_deg > 0 && *key.vertical_fov_deg < 180))
    line.refuse(fmt::format("a field of view of {} deg; allowed: more than 0 and less than 180",
                            *key.vertical_fov_deg));
  return key;
}

}  // namespace

std::vector<ChanKey> read_chan(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw Failure(ExitCode::BadInput, path.string() + ": no such camera file");
  std::ifstream file(path);
  std::vector<ChanKey> keys;
  int number = 0;
  for (std::string text; std::getline(file, text);) {
    const Line line{path, ++number};
    const std::optional<ChanKey> key = read_key(text, line);
    if (!key) continue;
    if (!keys.empty() && !(key->frame > keys.back().frame))
      line.refuse(fmt::format("frame {} comes after frame {}; needed: ascending frames", key->frame,
                              keys.back().frame));
    if (!keys.empty() && key->vertical_fov_deg.has_value() != keys.back().vertical_fov_deg.has_value())
      line.refuse("some lines have a field of view and others have none; needed: all or none");
    keys.push_back(*key);
  }
  if (file.bad()) throw Failure(ExitCode::BadInput, path.string() + ": cannot be read");
  if (keys.empty()) throw Failure(ExitCode::BadInput, path.string() + ": it has no frames; " + kLine);
  return keys;
}

std::string chan_text(const std::vector<ChanKey>& keys) {
  std::string text;
  for (const ChanKey& key : keys) {
    const Vec3 &t = key.position, &r = key.rotation_deg;
    text += fmt::format("{} {} {} {} {} {} {}", key.frame, t.x, t.y, t.z, r.x, r.y, r.z);
    if (key.vertical_fov_deg) text += fmt::format(" {}", *key.vertical_fov_deg);
    text += '\n';
  }
  return text;
}

}  // namespace lensplane
