// SPDX-License-Identifier: Apache-2.0
//
// A shot's maps for Blender: a Python script that builds a compositor graph.

#pragma once

#include <string>

#include "pipeline/handoff/handoff.h"

namespace lensplane {

/// For Blender 3.4 to 4:  blender --background --factory-startup --python SHOT.blender.py -a  writes
/// SHOT.blender.####.exr beside the script, overscan included. For each layer a Map UV, laid over one another
/// in the depth order of the first frame. Throws Failure (BadShot) when an image is a layer or part of a
/// file.
std::string blender_script(const Handoff& handoff);

}  // namespace lensplane
