// SPDX-License-Identifier: Apache-2.0
//
// lensplane export: what other programs need to go on with a shot.

#pragma once

#include "pipeline/cli/options.h"

namespace lensplane {

/// Writes the shot's camera to SHOT.chan in its folder, and says where. Throws Failure.
void run_export(const Options& options);

}  // namespace lensplane
