// SPDX-License-Identifier: Apache-2.0
//
// Running POV-Ray: one process of one thread for one picture, whose result is the same for every run.

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/image/picture.h"

namespace lensplane {

/// POV-Ray as it was found on this machine.
struct PovRay {
  std::string version;       // "3.7.0.10.unofficial"
  bool repeats_row = false;  // its mesh camera shows the first row twice, and everything else a row too low
};

/// Looks for `povray` in $PATH and tries it. Throws Failure (BadInput) when there is none, or one that is
/// older than 3.7. `folder`: where it may write; `mesh`: whether its mesh camera is tried, too.
PovRay find_povray(const std::filesystem::path& folder, bool mesh);

/// A picture to be rendered.
struct PovRayJob {
  std::filesystem::path scene;
  std::filesystem::path
      folder;  // an existing one of the job's own, with lensplane.inc; POV-Ray's working folder
  int width = 0, height = 0;
  int antialias = 1;  // n x n rays in pixels that differ from their neighbours; 1: one ray
  double clock = 0.0;
  double timeout_s = 600.0;  // without progress
};

/// What is asked, and what is told, while POV-Ray works.
struct PovRayHooks {
  std::function<void(const std::string& line)> say = [](const std::string&) {};  // its progress
  std::function<bool()> stop = [] { return false; };                             // asked all the time
};

/// A picture, and what POV-Ray found to be wrong with the scene all the same.
struct PovRayPicture {
  Picture picture;  // linear Rec.709, premultiplied
  std::vector<std::string> warnings;
};

/// Renders. Throws Failure: BadInput with POV-Ray's own words when it fails, ends by a signal, or makes no
/// progress for the job's timeout; TryAgain when it was told to stop.
PovRayPicture render_by_povray(const PovRayJob& job, const PovRayHooks& hooks);

}  // namespace lensplane
