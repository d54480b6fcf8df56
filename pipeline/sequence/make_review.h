// SPDX-License-Identifier: Apache-2.0
//
// The picture for review: what an artist looks at, through the shot's display and view.

#pragma once

#include "pipeline/composite/layering.h"
#include "pipeline/sequence/frame_report.h"
#include "pipeline/sequence/frame_setup.h"

namespace lensplane {

/// Writes the review picture of a frame; `looks` for its scene's surfaces. Throws Failure.
void make_review(const Shot& shot, const ColourConfig& colours, int frame, const FrameSetup& setup,
                 const Picture& picture, const std::vector<SurfaceLook>& looks, FrameReport& report);

}  // namespace lensplane
