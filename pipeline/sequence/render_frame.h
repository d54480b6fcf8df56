// SPDX-License-Identifier: Apache-2.0
//
// One frame of a shot: its maps, its picture, and the picture for review.

#pragma once

#include <filesystem>

#include "pipeline/colour/colour_config.h"
#include "pipeline/sequence/frame_report.h"
#include "pipeline/sequence/texture_store.h"
#include "pipeline/shot/shot.h"

namespace lensplane {

/// What is wanted of a frame, within what the shot's `output` asks for.
struct FrameTasks {
  bool maps = true;
  bool picture = true;
  bool redo = false;  // also what is done and right
};

/// Names of a frame's files.
std::filesystem::path picture_path(const Shot& shot, int frame);
std::filesystem::path map_path(const Shot& shot, const std::string& layer, int frame);
std::filesystem::path review_path(const Shot& shot, int frame);

/// Makes those of the frame's files that are not there or not right. Throws Failure.
FrameReport render_frame(const Shot& shot, const ColourConfig& colours, TextureStore& textures, int frame,
                         const FrameTasks& tasks);

}  // namespace lensplane
