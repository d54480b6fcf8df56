// SPDX-License-Identifier: Apache-2.0
//
// The tables of picture_quality.

#pragma once

#include <filesystem>

namespace lensplane {

/// Plates of 640 x 360 behind three masses: ours and the peers against the truth, and how lenses that move
/// make them flicker.
void report_plates(bool moving);

/// The six hard scenes. `errors`: where to write each scene's truth, render, comp and warp, and how far off
/// they are; nowhere when it is empty.
void report_hard_scenes(const std::filesystem::path& errors);

/// Things thinner than a pixel, the plate that nothing bends, the white sky, and the photon ring.
void report_small_things();

}  // namespace lensplane
