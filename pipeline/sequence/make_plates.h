// SPDX-License-Identifier: Apache-2.0
//
// The plates of a shot that POV-Ray renders: which are not there yet or not right, and making them, several
// frames side by side.
//
// A plate is rendered once: frames for which nothing is different, because the scene asks for nothing that
// changes, share what was rendered. Plates are files of the shot like all others: whole, with a fingerprint,
// and kept from one run to the next.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/sequence/plate_task.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// What has become of a plate.
struct PlateReport {
  std::string layer;
  int frame = 0;
  enum class How { Rendered, Shared, Done } how = How::Done;
  double seconds = 0;
  int overscan = 0;                   // pixels on every side
  std::vector<std::string> warnings;  // of POV-Ray
};

struct PlateHooks {
  std::function<void(const PlateReport&)> made = [](const PlateReport&) {};
  std::function<void(const std::string&)> say = [](const std::string&) {
  };  // "earth 1001: Rendered 5 of 100 pixels"
  std::function<bool()> stop = [] { return false; };
};

/// Makes the plates of all POV-Ray layers of the shot at `frames` that are not there or not right; with
/// `redo` all. As many processes at once as TBB may use threads. Throws Failure, located in the shot; plates
/// that are done stay done.
void make_plates(const Shot& shot, const std::vector<int>& frames, bool redo, const PlateHooks& hooks);

/// "1001: station: rendered by POV-Ray in 3.2 s, with 24 pixels more on each side".
std::string line_of(const PlateReport& report);

}  // namespace lensplane
