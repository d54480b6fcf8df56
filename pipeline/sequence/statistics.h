// SPDX-License-Identifier: Apache-2.0
//
// Statistics of a run as JSON: seconds and bytes per phase, rays, amplification factors.

#pragma once

#include <string>
#include <vector>

#include "pipeline/sequence/frame_report.h"

namespace lensplane {

/// The statistics as JSON text. `reports` ascend by frame.
std::string json_from_reports(const std::string& shot, int threads, double seconds,
                              const std::vector<FrameReport>& reports);

}  // namespace lensplane
