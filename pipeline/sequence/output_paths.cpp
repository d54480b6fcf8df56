// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/output_paths.h"

#include <fmt/format.h>

namespace lensplane {

std::filesystem::path picture_path(const Shot& shot, int frame) {
  return shot.output.directory / fmt::format("{}.{:04}.exr", shot.name, frame);
}

std::filesystem::path map_path(const Shot& shot, const std::string& layer, int frame) {
  return shot.output.directory / fmt::format("{}.{}.map.{:04}.exr", shot.name, layer, frame);
}

std::filesystem::path data_path(const Shot& shot, const std::string& layer, int frame) {
  return shot.output.directory / fmt::format("{}.{}.data.{:04}.exr", shot.name, layer, frame);
}

std::filesystem::path shadow_path(const Shot& shot, int frame) {
  return shot.output.directory / fmt::format("{}.shadow.{:04}.exr", shot.name, frame);
}

std::filesystem::path plate_path(const Shot& shot, const std::string& layer, int frame) {
  return shot.output.directory / fmt::format("{}.{}.plate.{:04}.exr", shot.name, layer, frame);
}

std::filesystem::path review_path(const Shot& shot, int frame) {
  const char* ending = shot.output.review == ReviewFormat::Tiff16 ? "tif" : "png";
  return shot.output.directory / fmt::format("{}.review.{:04}.{}", shot.name, frame, ending);
}

}  // namespace lensplane
