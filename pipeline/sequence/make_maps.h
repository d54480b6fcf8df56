// SPDX-License-Identifier: Apache-2.0
//
// The maps of a frame and the data files beside them.
//
// They are traced and written in bands, some rows at a time: however large the picture, little of it is in
// memory.

#pragma once

#include "pipeline/composite/empty_space.h"
#include "pipeline/sequence/frame_report.h"
#include "pipeline/sequence/frame_setup.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// What a band may take in memory, unless a single row of tiles takes more.
inline constexpr std::size_t kBandBytes = std::size_t{32} << 20;

/// Makes the maps and data files that `setup` wants. Returns where they have found nothing: of the plan
/// `setup.plan`; nothing is known unless all surfaces were traced by it. Throws Failure.
EmptySpace make_maps(const Shot& shot, int frame, const FrameSetup& setup, FrameReport& report);

}  // namespace lensplane
