// SPDX-License-Identifier: Apache-2.0
//
// Outputs that would overwrite what they are made from.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/shot/shot.h"

namespace lensplane {

/// Throws Failure (BadShot) when one of the files that `frames` of the shot will write, or `statistics`
/// (empty: none), is the shot file, its OCIO config, or a file of its layers, or when `statistics` is one
/// of the other outputs.
void refuse_overwriting(const Shot& shot, const std::vector<int>& frames, const std::string& statistics);

/// Throws Failure (BadShot) when one of `outputs` is a file that these frames of the shot are made from.
void refuse_overwriting_inputs(const Shot& shot, const std::vector<int>& frames,
                               const std::vector<std::filesystem::path>& outputs);

}  // namespace lensplane
