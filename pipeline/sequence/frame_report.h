// SPDX-License-Identifier: Apache-2.0
//
// What one frame took and gave.

#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/sequence/amplification.h"

namespace lensplane {

enum class Phase { Load, Trace, Composite, View, Write };
inline constexpr std::array<std::string_view, 5> kPhaseNames = {"load", "trace", "composite", "view",
                                                                "write"};

struct PhaseCost {
  double seconds = 0;
  std::size_t bytes = 0;  // pixels produced in memory; for Write, bytes on disk
};

/// Pixels of a layer's images that were NaN or infinite, and are black now.
struct ReplacedPixels {
  std::string layer;
  std::int64_t count;
};

/// A layer whose image of this frame is missing, and the frame that is shown instead; nothing for black.
struct MissingFrame {
  std::string layer;
  std::optional<int> shown;
};

struct FrameReport {
  int frame = 0;
  bool already_done = false;
  double seconds = 0;
  std::int64_t rays = 0;        // film positions traced through the lenses
  std::int64_t unresolved = 0;  // of them, given up on their way: they see nothing
  std::array<PhaseCost, kPhaseNames.size()> phases{};
  std::vector<Amplification> amplifications;
  std::vector<ReplacedPixels> replaced;
  std::vector<MissingFrame> missing;

  PhaseCost& operator[](Phase phase) { return phases[static_cast<std::size_t>(phase)]; }
  const PhaseCost& operator[](Phase phase) const { return phases[static_cast<std::size_t>(phase)]; }
};

/// Adds what a part of the frame took. Parts run side by side: the seconds of the phases may be more than the
/// frame's.
inline void add_costs(const FrameReport& part, FrameReport& sum) {
  sum.rays += part.rays;
  sum.unresolved += part.unresolved;
  for (std::size_t i = 0; i < sum.phases.size(); ++i) {
    sum.phases[i].seconds += part.phases[i].seconds;
    sum.phases[i].bytes += part.phases[i].bytes;
  }
}

/// Runs `work` and adds the time that it takes to `seconds`.
template <class Work>
auto timed(double& seconds, Work work) {
  struct Stopwatch {
    double& seconds;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    ~Stopwatch() {
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
  } stopwatch{seconds};
  return work();
}

}  // namespace lensplane
