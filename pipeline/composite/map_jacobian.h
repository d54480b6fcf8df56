// SPDX-License-Identifier: Apache-2.0
//
// How much of a picture each pixel of a map covers, from the map alone: differences between neighbours that
// belong together.
//
// Neighbours across a silhouette, the edge of a shadow, a cut of an edited map or the seam of a lat-long map
// are unrelated; a difference taken there would smear the picture over the whole jump. A step between two
// pixels counts as a jump when it is much longer than the steps around it in its row or column (kJump times
// their median) and longer than kShortStep. Folds (critical curves) are no jumps: steps are short there.

#pragma once

#include <vector>

#include "pipeline/composite/footprint.h"
#include "pipeline/image/map_reader.h"

namespace lensplane {

/// A step is a jump when it is this many times longer than the median of those around it.
inline constexpr double kJump = 4.0;

/// Steps up to this long, in pixels of the picture, are never jumps: they smear nothing, and half maps are as
/// rough.
inline constexpr double kShortStep = 1.5;

/// What the map is looked up in.
struct MappedPicture {
  int width = 0;  // pixels of its display window
  int height = 0;
  bool s_repeats = false;  // s = 0 and s = 1 are the same place: lat-long pictures and globes
  bool t_repeats = false;
};

/// The footprint of every pixel: the mean of the steps to both sides, the one that is no jump, or 0 where
/// there is none (a single sample). Steps to pixels without coverage are never used. Row by row; runs in
/// parallel.
std::vector<Footprint> footprints_from_differences(const StMap& map, const MappedPicture& picture);

/// The footprints of a jacobian, and those of differences where it is 0 though the map is valid: what was
/// painted into a map after it was traced.
std::vector<Footprint> footprints_from_jacobian(const StMap& map, const MapJacobian& jacobian,
                                                const MappedPicture& picture);

}  // namespace lensplane
