// SPDX-License-Identifier: Apache-2.0
//
// The picture of a frame from the maps on disk, as `comp` makes it: of every layer with a map, and of the
// stars, which have none.

#pragma once

#include "pipeline/composite/compositor.h"
#include "pipeline/sequence/frame_report.h"
#include "pipeline/sequence/frame_setup.h"
#include "pipeline/sequence/shot_assets.h"

namespace lensplane {

/// Layers are where their maps say. Stars are where the shot's lenses show them, and hidden where the maps
/// of anything but skies cover them. The shadow is that of its own file. Throws Failure (BadInput) when a map
/// or that file is missing or broken.
ShadowedPicture picture_from_maps(const Shot& shot, ShotAssets& assets, int frame, const FrameSetup& setup,
                                  const std::vector<SurfaceLook>& looks, FrameReport& report);

}  // namespace lensplane
