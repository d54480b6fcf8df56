// SPDX-License-Identifier: Apache-2.0
//
// The maps of a frame and the data files beside them.
//
// They are traced and written in bands, some rows at a time: however large the picture, little of it is in
// memory.

#pragma once

#include "pipeline/sequence/frame_report.h"
#include "pipeline/sequence/frame_setup.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// What a band may take in memory, unless a single row of tiles takes more.
inline constexpr std::size_t kBandBytes = std::size_t{32} << 20;

/// Makes the maps and data files that `setup` wants. Throws Failure.
void make_maps(const Shot& shot, int frame, const FrameSetup& setup, FrameReport& report);

}  // namespace lensplane
