// SPDX-License-Identifier: Apache-2.0
//
// What POV-Ray says while it works: its errors and warnings among everything else, and whether it gets on.

#pragma once

#include <chrono>
#include <set>
#include <string>
#include <vector>

namespace lensplane {

class PovRayLog {
 public:
  using Clock = std::chrono::steady_clock;

  /// The next line that it has said, at this moment.
  void add(const std::string& line, Clock::time_point now);

  /// When it last got on: rendered more pixels, or said something of a new kind.
  Clock::time_point last_progress() const { return last_progress_; }

  /// The lines that say what is wrong, in one; the last lines when none does.
  std::string complaint() const;
  /// The last lines, in one.
  std::string last_lines() const;
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::string> lines_;  // the last ones but for progress
  std::vector<std::string> errors_, warnings_;
  std::set<std::string> kinds_;
  long pixels_ = -1;
  Clock::time_point last_progress_ = Clock::now();
};

}  // namespace lensplane
