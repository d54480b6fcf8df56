// SPDX-License-Identifier: Apache-2.0
//
// How long work takes, and how much memory: repeated as often as is needed to tell.

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pipeline/sequence/frame_report.h"

namespace lensplane {

/// Seconds of several runs of the same work.
struct Timing {
  double median_s = 0;
  double least_s = 0;
  double most_s = 0;
  int repeats = 0;
  bool of_a_part = false;  // only a part was done; the seconds are those of the whole by its share
};

Timing timing_of(std::vector<double> seconds);

/// How often work is repeated: until all runs take `budget_s`, at least `least` and at most `most` times.
struct Repeats {
  double budget_s = 0.3;
  int least = 3;
  int most = 25;
  double longest_s = 0.5;  // of a single run: longer work is done in part, where that stands for the whole
  double enough_s = 3.0;   // no more runs after so long, even if they are fewer than `least`
};

template <class Work>
Timing time_repeatedly(const Repeats& repeats, Work work) {
  std::vector<double> seconds;
  double sum = 0;
  const auto more = [&](int runs) {
    return sum < repeats.enough_s &&
           (runs < repeats.least || (runs < repeats.most && sum < repeats.budget_s));
  };
  do {
    double once = 0;
    timed(once, work);
    seconds.push_back(once);
    sum += once;
  } while (more(static_cast<int>(seconds.size())));
  return timing_of(std::move(seconds));
}

/// `timing` of the whole, from that of a part.
Timing scaled(Timing timing, double whole_over_part);

/// The most memory that the process has held since this was made, beyond what it held then. The system keeps
/// one such mark: only one of these at a time.
class PeakMemory {
 public:
  PeakMemory();
  /// Nothing where the system does not tell.
  std::optional<std::size_t> bytes() const;

 private:
  std::optional<std::size_t> before_;
};

}  // namespace lensplane
