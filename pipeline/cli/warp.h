// SPDX-License-Identifier: Apache-2.0
//
// lensplane warp: any STMap, applied to any image.

#pragma once

#include "pipeline/cli/options.h"

namespace lensplane {

/// Writes the image as it is seen through the map. Filtered in linear light; an .exr has it in the config's
/// scene-linear space, a .png or .tif in the image's own space, or when that is linear as the config's first
/// display and view show it. Throws Failure.
void run_warp(const Options& options);

}  // namespace lensplane
