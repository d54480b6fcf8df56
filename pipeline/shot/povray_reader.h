// SPDX-License-Identifier: Apache-2.0
//
// The grammar of layers that POV-Ray renders.

#pragma once

#include "pipeline/shot/shot.h"
#include "pipeline/shot/value.h"

namespace lensplane {

/// Reads a layer `type: povray` of this name: what POV-Ray is to do, and the plate or sky that its pictures
/// are seen as. Throws Failure (BadShot).
Layer read_povray_layer(const Value& layer, const std::string& name);

}  // namespace lensplane
