// SPDX-License-Identifier: Apache-2.0
//
// One frame of a shot: its maps and their data files, its picture, and the picture for review.

#pragma once

#include "pipeline/colour/colour_config.h"
#include "pipeline/sequence/frame_report.h"
#include "pipeline/sequence/frame_setup.h"
#include "pipeline/sequence/shot_assets.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// Makes those of the frame's files that are not there or not right. Throws Failure.
FrameReport render_frame(const Shot& shot, const ColourConfig& colours, ShotAssets& assets, int frame,
                         const FrameTasks& tasks);

}  // namespace lensplane
