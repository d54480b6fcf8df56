// SPDX-License-Identifier: Apache-2.0
//
// The `layers` of a shot file.

#pragma once

#include "pipeline/shot/shot.h"
#include "pipeline/shot/shot_names.h"
#include "pipeline/shot/value.h"

namespace lensplane {

/// Reads one item of `layers`. Paths stay as they are written.
Layer read_layer(const Value& layer, const ShotNames& names);

/// The keys of a plate that say where it stands and what lies outside of it.
PlateLayer read_plate(const Value& layer);

/// What can be said of layers only together: rings refer to spheres with centres and lights, and plates at a
/// distance need a camera with a flat frame. `shot` holds all of them and the camera.
void check_layers(const Value& layers, const Shot& shot);

}  // namespace lensplane
