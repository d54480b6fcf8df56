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

/// Runs `work`; when an input fails there, the line says where the shot names it.
auto located_at(const LocatedText& named, auto work) {
  try {
    return work();
  } catch (const Failure& failure) {
    throw Failure(failure.code(), located(named.location, named.key, failure.what()));
  }
}

}  // namespace

ColourConfig load_colours(const Shot& shot, const char* environment) {
  const auto load = [&] {
    if (!shot.colour.config) return ColourConfig::load(std::nullopt, environment);
    return located_at(*shot.colour.config,
                      [&] { return ColourConfig::load(shot.colour.config->text, environment); });
  };
  ColourConfig colours = load();
  check_colours(shot, colours);
  return colours;
}

ViewSettings view_of(const Shot& shot) {
  const ColourSettings& colour = shot.colour;
  ViewSettings view{colour.working.text, colour.display.text, colour.view.text};
  if (colour.grade) {
    const std::string space = colour.grade->space ? colour.grade->space->text : colour.working.text;
    view.grade = Grade{colour.grade->cdl.text, colour.grade->id, space};
  }
  return view;
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
  if (const auto& grade = shot.colour.grade) {
    if (grade->space) require_space(*grade->space, colours);
    located_at(grade->cdl, [&] { colours.check_grade(*view_of(shot).grade); });
  }
}

}  // namespace lensplane
