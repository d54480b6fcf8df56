// SPDX-License-Identifier: Apache-2.0
//
// A shot's maps for Nuke: a script that looks the images up and lays them over one another.

#pragma once

#include <string>

#include "pipeline/handoff/handoff.h"

namespace lensplane {

/// For each layer a Read of the map (raw), a Read of the image, STMap, and the map's coverage as a mask;
/// merged in the depth order of the first frame, nearest first; a Write of SHOT.nuke.####.exr. Paths are
/// relative to the script. Throws Failure (BadShot) when an image is a layer or part of a file.
std::string nuke_script(const Handoff& handoff);

}  // namespace lensplane
