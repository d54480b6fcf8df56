// SPDX-License-Identifier: Apache-2.0
//
// What the files of a frame are called.

#pragma once

#include <filesystem>
#include <string>

#include "pipeline/shot/shot.h"

namespace lensplane {

std::filesystem::path picture_path(const Shot& shot, int frame);
std::filesystem::path map_path(const Shot& shot, const std::string& layer, int frame);
std::filesystem::path data_path(const Shot& shot, const std::string& layer, int frame);
/// Where the light of the frame ends in masses, beside the maps of a shot that has lenses.
std::filesystem::path shadow_path(const Shot& shot, int frame);
/// What POV-Ray has made of a layer.
std::filesystem::path plate_path(const Shot& shot, const std::string& layer, int frame);
std::filesystem::path review_path(const Shot& shot, int frame);

}  // namespace lensplane
