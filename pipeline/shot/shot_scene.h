// SPDX-License-Identifier: Apache-2.0
//
// From a shot to the scene of one of its frames, and to what its trace has to keep to.

#pragma once

#include "pipeline/shot/shot.h"
#include "src/plan.h"

namespace lensplane {

/// The scene at a frame (fractions allowed); its surfaces are the shot's layers, in the shot's order. Throws
/// Failure (BadShot) when the camera looks nowhere: at its own position, or straight along `up`.
Scene scene_at(const Shot& shot, double frame);

/// What the shot asks of the trace at a frame, with the effects that its data files call for.
TraceSettings trace_at(const Shot& shot, double frame);

/// A sphere's direction towards the light in the world; nothing for other layers and spheres without.
std::optional<Vec3> light_at(const Layer& layer, double frame);

/// The same shot at 1/`divisor` of the resolution, for a quick look.
Shot proxy_of(Shot shot, int divisor);

}  // namespace lensplane
