// SPDX-License-Identifier: Apache-2.0
//
// Where in a shot file something stands, for errors that lead straight to it.

#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace lensplane {

/// A place in a shot file, or in a value given on the command line. Lines and columns count from 1.
struct Location {
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;
};

/// "FILE:LINE:COLUMN: KEY: WHAT" (without "KEY: " when it is empty).
std::string located(const Location& location, const std::string& key, const std::string& what);

/// Throws Failure (BadShot) with the line of located(). `what` says what is wrong and what is allowed.
[[noreturn]] void refuse(const Location& location, const std::string& key, const std::string& what);

/// `text` between quotes as an error message shows it: on one line, and not more of it than one cares to
/// read.
std::string in_quotes(std::string_view text);

/// The texts one after another, with commas between them.
std::string comma_list(const auto& texts) {
  std::string list;
  for (const auto& text : texts) {
    if (!list.empty()) list += ", ";
    list += text;
  }
  return list;
}

}  // namespace lensplane
