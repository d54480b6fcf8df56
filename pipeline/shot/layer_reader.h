// SPDX-License-Identifier: Apache-2.0
//
// The `layers` of a shot file.

#pragma once

#include "pipeline/shot/not_yet.h"
#include "pipeline/shot/shot.h"
#include "pipeline/shot/shot_names.h"

namespace lensplane {

/// Reads one item of `layers`. Image paths stay as they are written. Nothing for a layer that is right but
/// not available yet.
std::optional<Layer> read_layer(const Value& layer, const ShotNames& names, NotYet& not_yet);

/// What can be said of layers only together: rings refer to spheres with centres and lights, and plates at a
/// distance need a camera with a flat frame. `shot` holds all of them and the camera.
void check_layers(const Value& layers, const Shot& shot);

}  // namespace lensplane
