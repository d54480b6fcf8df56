// SPDX-License-Identifier: Apache-2.0
//
// Cameras that come from other programs, and go there.

#pragma once

#include "pipeline/shot/chan_file.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// Reads the file that the shot's camera is taken from, if there is one, or the headers of a plate's images,
/// and makes its keys the camera's: straight from frame to frame, each angle by the shorter way. Throws
/// Failure (BadInput), located in the shot, when the file is missing or wrong, does not reach over all frames
/// of the shot, or says nothing about the field of view where the shot does not, or both do.
void read_camera_file(Shot& shot);

/// The shot's camera, which has to be perspective, at its frames; positions in metres. Throws Failure
/// (BadShot) where it looks at itself.
std::vector<ChanKey> chan_of_camera(const Shot& shot, const std::vector<int>& frames);

}  // namespace lensplane
