// SPDX-License-Identifier: Apache-2.0
//
// The `trace` of a shot file.

#pragma once

#include <optional>

#include "pipeline/shot/shot.h"
#include "pipeline/shot/value.h"

namespace lensplane {

/// Reads `trace` (nothing: everything as it is when it is left out) of a shot whose camera has `projection`.
TraceTrack read_trace(const std::optional<Value>& trace, Projection projection);

}  // namespace lensplane
