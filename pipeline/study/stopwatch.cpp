// SPDX-License-Identifier: Apache-2.0

#include "pipeline/study/stopwatch.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace lensplane {
namespace {

/// A figure of /proc/self/status, which gives it in KiB.
std::optional<std::size_t> status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name + ":")) return std::stoull(line.substr(name.size() + 1)) * 1024;
  }
  return std::nullopt;
}

}  // namespace

Timing timing_of(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  const std::size_t half = seconds.size() / 2;
  const double median = seconds.size() % 2 == 1 ? seconds[half] : 0.5 * (seconds[half - 1] + seconds[half]);
  return {median, seconds.front(), seconds.back(), static_cast<int>(seconds.size())};
}

Timing scaled(Timing timing, double whole_over_part) {
  for (double* seconds : {&timing.median_s, &timing.least_s, &timing.most_s}) *seconds *= whole_over_part;
  timing.of_a_part = whole_over_part != 1.0;
  return timing;
}

PeakMemory::PeakMemory() {
  ::malloc_trim(0);  // what is free, but kept, would be used without being seen
  constexpr const char* kResetPeak = "5";
  std::ofstream clear("/proc/self/clear_refs");
  if (clear << kResetPeak << std::flush) before_ = status_bytes("VmRSS");
}

std::optional<std::size_t> PeakMemory::bytes() const {
  const auto peak = status_bytes("VmHWM");
  if (!before_ || !peak) return std::nullopt;
  return *peak > *before_ ? *peak - *before_ : 0;
}

}  // namespace lensplane
