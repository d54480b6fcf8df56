// SPDX-License-Identifier: Apache-2.0
//
// The `camera` of a shot file.

#pragma once

#include "pipeline/shot/shot.h"
#include "pipeline/shot/shot_names.h"
#include "pipeline/shot/value.h"

namespace lensplane {

/// Reads `camera`; `names` are what it may look at. A layer that it looks at has to have a centre, which is
/// for the caller to see to.
CameraTrack read_camera(const Value& camera, const ShotNames& names);

}  // namespace lensplane
