// SPDX-License-Identifier: Apache-2.0

#include "pipeline/povray/povray_log.h"

#include <algorithm>
#include <cstdio>

namespace lensplane {
namespace {

constexpr std::size_t kLinesKept = 6;
constexpr std::size_t kKindsKept = 10000;

std::string without_digits(std::string line) {
  std::erase_if(line, [](unsigned char c) { return std::isdigit(c); });
  return line;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos) continue;
    text += (text.empty() ? "" : " ") + line.substr(first);
  }
  return text;
}

}  // namespace

void PovRayLog::add(const std::string& line, Clock::time_point now) {
  long pixels = 0;
  if (std::sscanf(line.c_str(), " Rendered %ld of", &pixels) == 1) {
    if (pixels > pixels_) last_progress_ = now;
    pixels_ = std::max(pixels_, pixels);
    return;
  }
  if (kinds_.size() < kKindsKept && kinds_.insert(without_digits(line)).second) last_progress_ = now;
  // Long lines are wrapped: what is wrong goes on from its first line to the last.
  const bool error = line.find("Error:") != std::string::npos && line.find("Possible") == std::string::npos;
  const bool said_all = line.starts_with("Fatal error") || line.starts_with("Render failed");
  if ((error || !errors_.empty()) && !said_all && errors_.size() < kLinesKept) errors_.push_back(line);
  if (line.find("Warning:") != std::string::npos && line.find("experimental feature") == std::string::npos)
    warnings_.push_back(line);
  lines_.push_back(line);
  if (lines_.size() > kLinesKept) lines_.erase(lines_.begin());
}

std::string PovRayLog::complaint() const {
  return errors_.empty() ? last_lines() : joined(errors_);
}

std::string PovRayLog::last_lines() const {
  return joined(lines_);
}

}  // namespace lensplane
