// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/shot_colours.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/image/failure.h"
#include "pipeline/shot/layer_files.h"

namespace lensplane {
namespace {

void require_among(const LocatedText& name, const std::vector<std::string>& allowed, std::string_view noun) {
  if (std::find(allowed.begin(), allowed.end(), name.text) != allowed.end()) return;
  refuse(name.location, name.key,
         fmt::format("{} is no {} of the OCIO config; allowed: {}", in_quotes(name.text), noun,
                     comma_list(allowed)));
}

void require_space(const LocatedText& name, const ColourConfig& colours) {
  if (!colours.has_space(name.text)) require_among(name, colours.spaces(), "colour space");
}

}  // namespace

ColourConfig load_colours(const Shot& shot, const char* environment) {
  const auto load = [&] {
    if (!shot.colour.config) return ColourConfig::load(std::nullopt, environment);
    try {
      return ColourConfig::load(shot.colour.config->text, environment);
    } catch (const Failure& failure) {
      throw Failure(failure.code(),
                    located(shot.colour.config->location, shot.colour.config->key, failure.what()));
    }
  };
  ColourConfig colours = load();
  check_colours(shot, colours);
  return colours;
}

void check_colours(const Shot& shot, const ColourConfig& colours) {
  require_space(shot.colour.working, colours);
  if (!colours.is_scene_linear(shot.colour.working.text)) {
    refuse(shot.colour.working.location, shot.colour.working.key,
           in_quotes(shot.colour.working.text) + " is not linear; allowed: scene-linear spaces, like ACEScg");
  }
  require_among(shot.colour.display, colours.displays(), "display");
  require_among(shot.colour.view, colours.views(shot.colour.display.text), "view of this display");
  for (const Layer& layer : shot.layers) {
    for (const LayerImage* image : images_of(layer)) {
      if (image->space) require_space(*image->space, colours);
    }
  }
}

}  // namespace lensplane
