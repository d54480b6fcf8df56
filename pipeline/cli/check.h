// SPDX-License-Identifier: Apache-2.0
//
// lensplane check: is the shot right?

#pragma once

#include "pipeline/cli/options.h"

namespace lensplane {

/// Reads the shot and evaluates every frame, reads no image, and says in one line what it is. Throws Failure.
void run_check(const Options& options);

}  // namespace lensplane
