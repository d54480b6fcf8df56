// SPDX-License-Identifier: Apache-2.0
//
// lensplane export: what other programs need to go on with a shot.

#pragma once

#include "pipeline/cli/options.h"

namespace lensplane {

/// Writes, in the shot's folder or --output, its camera to SHOT.chan, or what makes its picture from its
/// maps: SHOT.nk, SHOT.blender.py or SHOT.oiio.json. Says where, and what other programs leave out. Throws
/// Failure.
void run_export(const Options& options);

}  // namespace lensplane
