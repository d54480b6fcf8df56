// SPDX-License-Identifier: Apache-2.0

#include "pipeline/cli/check.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "pipeline/sequence/shot_colours.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

std::string counted(std::size_t count, std::string_view noun, std::string_view plural) {
  return fmt::format("{} {}", count, count == 1 ? noun : plural);
}

}  // namespace

void run_check(const Options& options) {
  const Shot shot = shot_of(options);
  check_colours(
      shot, ColourConfig::load(shot.colour.config ? std::optional(shot.colour.config->text) : std::nullopt,
                               std::getenv("OCIO")));
  const std::vector<int> frames = frames_of(options, shot);
  for (const int frame : frames) scene_at(shot, frame);
  if (options.quiet) return;
  const std::string line =
      fmt::format("{}: right: {} of {} x {}, {}, {}\n", shot.file, counted(frames.size(), "frame", "frames"),
                  shot.camera.width, shot.camera.height, counted(shot.lenses.size(), "lens", "lenses"),
                  counted(shot.layers.size(), "layer", "layers"));
  std::fputs(line.c_str(), stdout);
}

}  // namespace lensplane
