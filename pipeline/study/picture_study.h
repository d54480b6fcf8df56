// SPDX-License-Identifier: Apache-2.0
//
// What rays cost in a picture: more of them at edges, and finer traces, against a truth of very many.

#pragma once

#include "pipeline/sequence/shot_assets.h"
#include "pipeline/shot/shot.h"
#include "pipeline/study/study.h"
#include "pipeline/study/study_hooks.h"

namespace lensplane {

/// About how long the rays of one picture of the frame take, from a few of them.
double guess_picture_s(const Shot& shot, int frame, const StudyEffort& effort);

/// Fills the rows of pictures: the frame's instant, without stars, motion blur and glow, which do not depend
/// on how it is sampled. Throws Failure when an image cannot be read.
void study_pictures(const Shot& shot, ShotAssets& assets, int frame, const StudyEffort& effort,
                    const StudyHooks& hooks, Study& study);

}  // namespace lensplane
