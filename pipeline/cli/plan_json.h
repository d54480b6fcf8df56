// SPDX-License-Identifier: Apache-2.0
//
// Plans as programs read them; the keys stand in docs/shot-format.md.

#pragma once

#include <string>
#include <vector>

#include "pipeline/cli/planned_frame.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// Everything about the plans. Numbers come back bit for bit; what has no limit is null.
std::string json_from_plans(const Shot& shot, const std::vector<PlannedFrame>& plans);

}  // namespace lensplane
