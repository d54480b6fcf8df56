// SPDX-License-Identifier: Apache-2.0
//
// How many threads a command and the libraries under it use.

#pragma once

#include <tbb/global_control.h>

namespace lensplane {

/// As long as it lives, no more threads than these are used.
class Threads {
 public:
  /// `wanted` 0: one for each core.
  explicit Threads(int wanted);
  int count() const { return count_; }

 private:
  int count_;
  tbb::global_control limit_;
};

}  // namespace lensplane
