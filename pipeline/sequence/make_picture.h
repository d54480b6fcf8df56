// SPDX-License-Identifier: Apache-2.0
//
// The picture of a frame: composited over the time that the shutter is open, with its stars and the camera's
// glow, written as EXR and, through the view, for review.

#pragma once

#include "pipeline/composite/empty_space.h"
#include "pipeline/composite/layering.h"
#include "pipeline/sequence/frame_report.h"
#include "pipeline/sequence/frame_setup.h"
#include "pipeline/sequence/shot_assets.h"

namespace lensplane {

/// Reads what the picture of a frame is made of: images, which are returned, and stars, which `assets` keeps.
/// Throws Failure (BadInput).
std::vector<SurfaceLook> load_picture(const Shot& shot, ShotAssets& assets, int frame,
                                      const FrameSetup& setup, FrameReport& report);

/// Makes the files of the picture that `setup` says are wanted. `looks`: from load_picture(); `empty`: what
/// the frame's maps know. Throws Failure.
void make_picture(const Shot& shot, const ColourConfig& colours, ShotAssets& assets, int frame,
                  const FrameTasks& tasks, const FrameSetup& setup, const std::vector<SurfaceLook>& looks,
                  const EmptySpace& empty, FrameReport& report);

/// The amplification that a picture's header keeps: those of a frame that is done already.
std::vector<Amplification> kept_amplifications(const Shot& shot, int frame);

}  // namespace lensplane
