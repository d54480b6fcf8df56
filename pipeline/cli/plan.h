// SPDX-License-Identifier: Apache-2.0
//
// lensplane plan: what will be simulated, and why.

#pragma once

#include "pipeline/cli/options.h"

namespace lensplane {

/// Prints the plan of the frames that `options` ask for, of the shot's first frame when they ask for none: a
/// table each, or all as JSON. Reads no image. Throws Failure.
void run_plan(const Options& options);

}  // namespace lensplane
