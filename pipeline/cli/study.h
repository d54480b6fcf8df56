// SPDX-License-Identifier: Apache-2.0
//
// lensplane study: what accuracy costs in time, of one frame.

#pragma once

#include <functional>

#include "pipeline/cli/options.h"

namespace lensplane {

/// Writes study.csv, study.json and study.html in a folder of their own and prints the tables. Throws
/// Failure, also (BadShot) when a plan's bound was violated, after everything is written.
void run_study_command(const Options& options, const std::function<bool()>& interrupted);

}  // namespace lensplane
