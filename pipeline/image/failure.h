// SPDX-License-Identifier: Apache-2.0
//
// What is thrown when the outside world is not as it has to be: one exception type, caught in main.
//
// A Failure's text is the one line that the user reads: what, where, and what to do. Bugs are assertions
// instead, and numerical outcomes (a captured ray, say) are values.

#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace lensplane {

enum class ExitCode {
  Done = 0,
  BadShot = 1,    // the shot or the command line is wrong
  BadInput = 2,   // an input is missing or broken
  BadOutput = 3,  // an output could not be written
  TryAgain = 75,  // interrupted, or worth another try
};

/// `text` without line breaks.
inline std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

class Failure : public std::runtime_error {
 public:
  /// Line breaks in `line`, from the messages of libraries, become spaces.
  Failure(ExitCode code, std::string line) : std::runtime_error(one_line(std::move(line))), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace lensplane
