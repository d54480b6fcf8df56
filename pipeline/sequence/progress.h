// SPDX-License-Identifier: Apache-2.0
//
// What the user sees while frames are made: a line per frame, and on a terminal a status line below them.

#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "pipeline/sequence/frame_report.h"

namespace lensplane {

class Progress {
 public:
  /// Lines go to standard output, unless `quiet`; the status line to standard error when it is a terminal.
  Progress(std::size_t frames, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void frame_done(const FrameReport& report);

  /// A line about something else that is done, and what is being done, in the place of the status line.
  void say(const std::string& line) const;
  void show(const std::string& doing) const;

 private:
  void clear_status() const;
  void show_status() const;

  std::size_t frames_;
  std::size_t frames_done_ = 0;
  std::size_t frames_made_ = 0;
  std::int64_t rays_ = 0;
  bool quiet_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// "1001: 0.31 s, 8.2 million rays/s, A(earth) = 4.46", or "1001: already done, ...".
std::string line_of(const FrameReport& report);

}  // namespace lensplane
