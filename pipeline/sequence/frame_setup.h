// SPDX-License-Identifier: Apache-2.0
//
// What has to be made of a frame: its scene, its headers with their fingerprints, and which of its files are
// not there yet or not right.

#pragma once

#include <string>
#include <vector>

#include "pipeline/colour/colour_config.h"
#include "pipeline/image/exr_writer.h"
#include "pipeline/sequence/texture_store.h"
#include "pipeline/shot/shot.h"
#include "src/plan.h"

namespace lensplane {

/// What is wanted of a frame, within what the shot's `output` asks for.
struct FrameTasks {
  bool maps = true;
  bool picture = true;
  bool redo = false;       // also what is done and right
  bool from_maps = false;  // the picture is made from the maps on disk, and no light is traced
};

/// Everything that is known about a frame before any light is traced.
struct FrameSetup {
  Scene scene;
  Plan plan;       // of the picture and the maps: no effects
  Plan data_plan;  // of the data files, where the shot asks for them: what they hold beside
  ExrHeader map_header;
  ExrHeader data_header;
  ExrHeader shadow_header;
  ExrHeader picture_header;
  std::string review_parameters;
  std::vector<std::size_t> maps;  // layers whose maps are wanted and not there, ascending
  std::vector<std::size_t> data;  // the same for their data files
  bool shadow = false;            // whether the file of where light ends is wanted and not there
  bool picture = false;           // whether picture or review are wanted and not there
};

/// Evaluates the shot at a frame and looks at the files that are there. Throws Failure.
FrameSetup set_up_frame(const Shot& shot, const ColourConfig& colours, TextureStore& textures, int frame,
                        const FrameTasks& tasks);

}  // namespace lensplane
