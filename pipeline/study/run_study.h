// SPDX-License-Identifier: Apache-2.0
//
// A whole study: traces, prices, pictures.

#pragma once

#include "pipeline/colour/colour_config.h"
#include "pipeline/shot/shot.h"
#include "pipeline/study/study.h"
#include "pipeline/study/study_hooks.h"

namespace lensplane {

/// Studies a frame. Where an image is missing or broken pictures or their prices are left out, and a note
/// says why. What `hooks` interrupt holds what was done until then. Throws Failure as scene_at.
Study run_study(const Shot& shot, const ColourConfig& colours, int frame, int threads,
                const StudyEffort& effort, const StudyHooks& hooks);

/// Throws Failure (BadShot) that names them when plans have left out more than they said.
void require_bounds(const Study& study);

}  // namespace lensplane
