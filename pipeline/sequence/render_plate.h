// SPDX-License-Identifier: Apache-2.0
//
// One plate by POV-Ray.

#pragma once

#include "pipeline/sequence/plate_task.h"

namespace lensplane {

/// Renders all passes of a task in folders of their own in the shot's folder for output; their mean. Pixels
/// of bent rays that end in a mass are transparent black. Throws Failure as render_by_povray.
PovRayPicture render_plate(const Shot& shot, const PlateTask& task, const PovRay& povray,
                           const PovRayHooks& hooks);

}  // namespace lensplane
