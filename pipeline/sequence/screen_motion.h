// SPDX-License-Identifier: Apache-2.0
//
// How fast what a frame shows moves over the film, without tracing any light: what motion blur has to be
// sampled for.
//
// Followed are: lenses and the circles of Einstein round them, which carry the light beside them along; the
// outlines of spheres and rings, and the points of their surfaces that the frame shows, which turn with them;
// the edge of their shadow; and what lies at infinity, by the directions of points all over the frame. Images
// that sweep along a critical curve are faster than all of these for a moment; they are not followed.

#pragma once

#include "pipeline/shot/shot.h"

namespace lensplane {

/// Pixels that the fastest of all that moves in the frame goes while the shutter is open, by its speed at the
/// fastest of several moments. 0 where nothing moves, or the shutter never opens. Throws Failure as scene_at.
double screen_motion(const Shot& shot, int frame);

}  // namespace lensplane
