// SPDX-License-Identifier: Apache-2.0
//
// A shot's maps for oiiotool: for each frame the arguments that make its picture, as JSON, without a shell.

#pragma once

#include <string>

#include "pipeline/handoff/handoff.h"

namespace lensplane {

/// {lensplane, shot, output, frames: [{frame, commands: [[argument, ...], ...]}, ...]}, to be run in the
/// folder where the file lies. The picture is SHOT.oiio.####.exr, in the working space.
std::string oiio_commands(const Handoff& handoff);

/// What oiiotool, besides, does not show: words for a list.
std::vector<std::string> left_out_by_oiiotool(const Handoff& handoff);

}  // namespace lensplane
