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
    try {
      value.refuse("not available yet: " + what);
    } catch (const Failure& failure) {
      failures_.push_back(failure);
    }
  }

  void throw_first() const {
    if (!failures_.empty()) throw failures_.front();
  }

 private:
  std::vector<Failure> failures_;
};

/// The names that other parts of the shot may refer to, in file order.
struct ShotNames {
  std::vector<std::string> lenses;
  std::vector<std::string> layers;
};

}  // namespace lensplane
