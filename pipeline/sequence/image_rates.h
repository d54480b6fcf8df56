// SPDX-License-Identifier: Apache-2.0
//
// Sequences that were made for another frame rate than the shot's: their pictures are shown frame by frame
// all the same, and so faster or slower than they were meant to be.

#pragma once

#include <string>
#include <vector>

#include "pipeline/shot/shot.h"

namespace lensplane {

/// "layer bg: its images say 25 frames per second, the shot 24; ..." for each sequence of EXR images whose
/// first file among `frames` says another rate (framesPerSecond) than the shot. Files that are missing or
/// broken say nothing here.
std::vector<std::string> other_rates(const Shot& shot, const std::vector<int>& frames);

}  // namespace lensplane
