// SPDX-License-Identifier: Apache-2.0
//
// lensplane probe: one film position in full.

#pragma once

#include "pipeline/cli/options.h"

namespace lensplane {

/// Follows the ray of one film position at one frame and prints all that happens to it, as text or JSON.
/// Reads no image. Throws Failure.
void run_probe(const Options& options);

}  // namespace lensplane
