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

/// The layers of a shot as its outputs name them.
struct OutputLayers {
  std::vector<std::string> names;
  std::vector<bool> have_maps;  // stars have none
};

/// Reads `output` (nothing: everything as it is when it is left out) of the shot `name` with these `layers`.
/// The directory stays as it is written.
OutputSettings read_output(const std::optional<Value>& output, const std::string& name,
                           const OutputLayers& layers, NotYet& not_yet);

}  // namespace lensplane
