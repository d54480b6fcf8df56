// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/location.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/image/failure.h"

namespace lensplane {

std::string located(const Location& location, const std::string& key, const std::string& what) {
  constexpr std::size_t kLongestKey = 200;
  return fmt::format("{}:{}:{}: {}{}{}", *location.file, location.line, location.column,
                     key.substr(0, kLongestKey), key.empty() ? "" : ": ", what);
}

void refuse(const Location& location, const std::string& key, const std::string& what) {
  throw Failure(ExitCode::BadShot, located(location, key, what));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kShown = 60;
  std::string shown(text.substr(0, kShown));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  return "\"" + shown + (text.size() > kShown ? "...\"" : "\"");
}

}  // namespace lensplane
