// SPDX-License-Identifier: Apache-2.0
//
// lensplane render, map and comp: frames of a shot, made.

#pragma once

#include <functional>

#include "pipeline/cli/options.h"

namespace lensplane {

/// Makes the frames that `options` ask for: everything, for Command::Map the maps alone, for Command::Comp
/// the pictures from the maps that are there. Begins no frame
/// after `interrupted()` holds. Throws Failure.
void run_render(const Options& options, const std::function<bool()>& interrupted);

}  // namespace lensplane
