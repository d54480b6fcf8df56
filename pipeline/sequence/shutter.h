// SPDX-License-Identifier: Apache-2.0
//
// Motion blur: the moments at which a frame is taken while the shutter is open, and the rays that each takes.

#pragma once

#include <vector>

#include "pipeline/composite/sample_pattern.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// One of the instants that a picture is the mean of.
struct Moment {
  double time;        // in frames
  Sampling sampling;  // of this instant's pixels: together they get about as many rays as one instant would
};

/// The moments of a frame: the middles of as many equal parts of the time that the shutter is open. With one
/// sample that is the frame itself, whenever the shutter opens: it then shows what the frame's maps show.
std::vector<Moment> moments_of(const Shot& shot, int frame);

}  // namespace lensplane
