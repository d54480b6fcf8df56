// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace lensplane {
namespace {

std::string minutes_and_seconds(double seconds) {
  const int whole = static_cast<int>(seconds + 0.5);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(std::size_t frames, bool quiet)
    : frames_(frames), quiet_(quiet), terminal_(!quiet && ::isatty(STDERR_FILENO)) {
  show_status();
}

Progress::~Progress() {
  clear_status();
}

void Progress::frame_done(const FrameReport& report) {
  ++frames_done_;
  if (!report.already_done) ++frames_made_;
  rays_ += report.rays;
  if (quiet_) return;
  clear_status();
  std::fputs((line_of(report) + "\n").c_str(), stdout);
  std::fflush(stdout);
  show_status();
}

void Progress::say(const std::string& line) const {
  if (quiet_) return;
  clear_status();
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void Progress::show(const std::string& doing) const {
  constexpr std::size_t kLineOfTerminal = 79;
  if (!terminal_) return;
  clear_status();
  std::fputs(doing.substr(0, kLineOfTerminal).c_str(), stderr);
  std::fflush(stderr);
}

void Progress::clear_status() const {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::show_status() const {
  if (!terminal_ || frames_done_ == frames_) return;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::string status = fmt::format("{} of {} frames done", frames_done_, frames_);
  if (frames_made_ > 0) {
    const double left =
        elapsed / static_cast<double>(frames_made_) * static_cast<double>(frames_ - frames_done_);
    status += fmt::format(", {:.1f} million rays/s, {} left", static_cast<double>(rays_) / elapsed / 1e6,
                          minutes_and_seconds(left));
  }
  std::fputs(status.c_str(), stderr);
  std::fflush(stderr);
}

std::string line_of(const FrameReport& report) {
  std::string line = fmt::format("{:04}: ", report.frame);
  if (report.already_done) {
    line += "already done";
  } else {
    line += fmt::format("{:.2f} s, {:.1f} million rays/s", report.seconds,
                        static_cast<double>(report.rays) / report.seconds / 1e6);
  }
  for (const Amplification& a : report.amplifications) {
    line += a.factor ? fmt::format(", A({}) = {:.3f}", a.layer, *a.factor)
                     : fmt::format(", A({}): not in the frame without lenses", a.layer);
  }
  if (report.unresolved > 0) {
    line += fmt::format(", {} {} given up and {} nothing", report.unresolved,
                        report.unresolved == 1 ? "ray was" : "rays were",
                        report.unresolved == 1 ? "sees" : "see");
  }
  for (const ReplacedPixels& replaced : report.replaced) {
    line += fmt::format(", {}: {} {} black for NaN or infinity", replaced.layer, replaced.count,
                        replaced.count == 1 ? "pixel" : "pixels");
  }
  for (const MissingFrame& missing : report.missing) {
    line += fmt::format(", {}: its image is missing, {}", missing.layer,
                        missing.shown ? fmt::format("{:04} is shown", *missing.shown) : "black");
  }
  return line;
}

}  // namespace lensplane
