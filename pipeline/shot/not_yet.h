// SPDX-License-Identifier: Apache-2.0
//
// What a shot asks for, rightly, that this version of lensplane cannot do.

#pragma once

#include <string>
#include <vector>

#include "pipeline/image/failure.h"
#include "pipeline/shot/value.h"

namespace lensplane {

/// Collected while a shot is read and reported last, so that mistakes in the shot come first.
class NotYet {
 public:
  /// "KEY: not available yet: WHAT".
  void add(const Value& value, const std::string& what) {
    lines_.push_back(located(value.location(), value.key(), "not available yet: " + what));
  }

  void throw_first() const {
    if (!lines_.empty()) throw Failure(ExitCode::BadShot, lines_.front());
  }

 private:
  std::vector<std::string> lines_;
};

}  // namespace lensplane
