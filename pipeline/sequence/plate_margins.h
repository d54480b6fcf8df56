// SPDX-License-Identifier: Apache-2.0
//
// How much of a plate's outside lenses bring into the frame, known before anything is rendered: what a plate
// has to have beyond its edges, and what `overscan: auto` is.

#pragma once

#include <string>
#include <vector>

#include "pipeline/shot/shot.h"

namespace lensplane {

/// What a frame's pixels, without overscan, look up of one plate.
struct PlateMargin {
  std::string layer;
  int frame = 0;
  double outside = 0;  // share of the pixels that look outside of the plate's frame
  int most = 0;        // pixels beyond its edges that serve all but kUnserved of them
  int all = 0;         // that serve all, up to kFarthestMargin
};

/// Close to a black hole a few pixels look anywhere: those no margin serves.
inline constexpr double kUnserved = 1e-3;

/// Larger margins are called this.
inline constexpr int kFarthestMargin = 1 << 16;

/// The margins of all plates of the shot at a frame, from about `rays` pixels of it. Empty without plates.
/// Throws Failure as scene_at.
std::vector<PlateMargin> plate_margins(const Shot& shot, int frame, int rays);

/// For each plate the worst of several frames; those of which nothing outside is looked up are left out.
std::vector<PlateMargin> worst_margins(const Shot& shot, const std::vector<int>& frames);

/// How far a plate has to reach beyond the frame, in pixels on every side, for all that the picture of a
/// frame looks up of it, overscan and the time that the shutter is open included: an even number that serves
/// all but kUnserved of the pixels, at most the larger side of the frame. 0 for a lat-long camera, which sees
/// everything.
int needed_overscan(const Shot& shot, std::size_t layer, int frame);

/// "layer bg: frame 1001 looks outside of the plate with 3.1 % of its pixels; ..."
std::string line_of(const PlateMargin& margin);

/// The shot with the overscan that `auto` stands for: an even number of pixels that serves all its plates in
/// all its frames but for kUnserved, at most the larger side of the frame. Other shots stay as they are.
Shot with_overscan(Shot shot);

}  // namespace lensplane
