// SPDX-License-Identifier: Apache-2.0
//
// What every effect and pass adds to the time of a frame, and what the plan has left out.
//
// Each is measured by itself: the frame with it against the frame without. Passes of the trace, finite
// distance, and more rays at edges are measured also where the shot does without: that is what is saved.

#pragma once

#include "pipeline/sequence/shot_assets.h"
#include "pipeline/shot/shot.h"
#include "pipeline/study/study.h"
#include "pipeline/study/study_hooks.h"

namespace lensplane {

/// Fills the prices of the trace, and the fate of every lens in the shot's own plan.
void price_traces(const Shot& shot, int frame, const StudyEffort& effort, const StudyHooks& hooks,
                  Study& study);

/// Adds the prices of the picture, of the frame's instant: edges, stars, motion blur, glow, night side,
/// light, shadows, further crossings, the view. Throws Failure when an image or a catalogue cannot be read.
void price_pictures(const Shot& shot, const ColourConfig& colours, ShotAssets& assets, int frame,
                    const StudyEffort& effort, const StudyHooks& hooks, Study& study);

}  // namespace lensplane
