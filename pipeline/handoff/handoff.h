// SPDX-License-Identifier: Apache-2.0
//
// What other programs need of a shot to make its picture from its maps: which layers there are, where their
// maps and images lie, what their images' colours and alpha mean, in which order they lie over one another.
//
// All paths are relative to the folder in which a script is written, so that the whole can be moved.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/colour/colour_config.h"
#include "pipeline/image/image_outline.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// A layer that has a map.
struct HandedLayer {
  std::size_t layer = 0;  // index into Shot::layers
  std::string name;
  std::string map;                                // a sequence
  std::string image;                              // a file, or a sequence
  int first_frame = 0;                            // of a sequence, that there is
  ImageOutline outline;                           // of the image at that frame
  std::string space;                              // of its colours, in the shot's config
  std::string space_id;                           // its colorInteropID; empty when it has none
  AlphaKind alpha = AlphaKind::None;              // what its alpha is, which it may not have
  Edge edge = Edge::Clamp;                        // what is seen outside of it
  std::vector<std::optional<std::string>> files;  // of the image at each frame; nothing for black
  std::vector<double> gains;  // of its light at each frame, the camera's exposure included

  bool has_gain() const;
};

struct Handoff {
  Shot shot;
  std::vector<int> frames;
  std::filesystem::path folder;            // of the script
  std::string config;                      // the OCIO config
  std::string working_id;                  // the working space's colorInteropID; empty when it has none
  std::string shadow;                      // a sequence: what is added to the alpha; empty when nothing is
  std::vector<HandedLayer> layers;         // in the shot's order
  std::vector<std::vector<int>> by_depth;  // for each frame: indices into `layers`, farthest first
};

/// Throws Failure: BadShot when the shot makes no map of one of these layers; BadInput when an image is not
/// there.
Handoff hand_off(const Shot& shot, const std::vector<int>& frames, const std::filesystem::path& folder,
                 const ColourConfig& colours);

/// What of this shot is seen in lensplane's own picture and in no other program's: words for a list.
std::vector<std::string> left_out(const Handoff& handoff);

/// The first frame at which layers lie over one another in another order than at the first of all; nothing
/// when they never do.
std::optional<int> reordered_at(const Handoff& handoff);

/// `path` as it is found from `folder`.
std::string relative_to(const std::filesystem::path& path, const std::filesystem::path& folder);

/// From (s, t), which are shares of an image's display window, to shares of a canvas of `width` x `height`
/// pixels on which its data window begins `left` and `top` pixels from the upper left corner: (s, t) times
/// `scale` plus `offset`.
struct MapScale {
  double scale[2] = {1, 1};
  double offset[2] = {0, 0};
};
MapScale scale_to_canvas(const PixelWindows& image, int left, int top, int width, int height);

/// What the shot's frame has with its overscan.
struct FullSize {
  int width, height;
};
FullSize full_size(const CameraTrack& camera);

}  // namespace lensplane
