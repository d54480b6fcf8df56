// SPDX-License-Identifier: Apache-2.0
//
// The `output` of a shot file.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/shot/not_yet.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// Reads `output` (nothing: everything as it is when it is left out) of the shot `name` with these `layers`.
/// The directory stays as it is written.
OutputSettings read_output(const std::optional<Value>& output, const std::string& name,
                           const std::vector<std::string>& layers, NotYet& not_yet);

}  // namespace lensplane
