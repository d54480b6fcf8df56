// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/image_rates.h"

#include <fmt/format.h>

#include <cmath>

#include "pipeline/image/exr_writer.h"
#include "pipeline/image/frame_path.h"
#include "pipeline/image/shipped.h"
#include "pipeline/shot/layer_files.h"

namespace lensplane {
namespace {

/// Rates that are written with few digits, like 23.976, are the same.
constexpr double kSameRate = 1e-4;

double per_second(const Rational& rate) {
  return static_cast<double>(rate.numerator) / rate.denominator;
}

/// Of the first of the frames that says one.
std::optional<Rational> rate_of(const LayerImage& image, const std::vector<int>& frames) {
  const std::string& pattern = image.pattern.text;
  if (!is_sequence(pattern) || !pattern.ends_with(".exr")) return std::nullopt;
  for (const int frame : frames) {
    if (const auto rate = read_frame_rate(resolve_shipped(path_of_frame(pattern, frame)))) return rate;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> other_rates(const Shot& shot, const std::vector<int>& frames) {
  std::vector<std::string> lines;
  for (const Layer& layer : shot.layers) {
    for (const LayerImage* image : images_of(layer)) {
      const auto rate = rate_of(*image, frames);
      if (!rate || std::abs(per_second(*rate) / per_second(shot.fps) - 1.0) < kSameRate) continue;
      lines.push_back(
          fmt::format("layer {}: its images say {:.6g} frames per second, the shot {:.6g}; they are shown "
                      "frame by frame",
                      layer.name, per_second(*rate), per_second(shot.fps)));
    }
  }
  return lines;
}

}  // namespace lensplane
