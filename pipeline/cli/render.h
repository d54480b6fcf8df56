// SPDX-License-Identifier: Apache-2.0
//
// lensplane render and lensplane map: frames of a shot, made.

#pragma once

#include <functional>

#include "pipeline/cli/options.h"

namespace lensplane {

/// Makes the frames that `options` ask for: everything, or for Command::Map the maps alone. Begins no frame
/// after `interrupted()` holds. Throws Failure.
void run_render(const Options& options, const std::function<bool()>& interrupted);

}  // namespace lensplane
