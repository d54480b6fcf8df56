// SPDX-License-Identifier: Apache-2.0

#include "pipeline/handoff/handoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/image/failure.h"
#include "pipeline/image/frame_path.h"
#include "pipeline/image/image_reader.h"
#include "pipeline/image/shipped.h"
#include "pipeline/sequence/located_in_shot.h"
#include "pipeline/sequence/map_layers.h"
#include "pipeline/sequence/shutter.h"
#include "pipeline/sequence/texture_store.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

void require_map(const Shot& shot, std::size_t layer) {
  if (shot.output.maps[layer]) return;
  const std::string& name = shot.layers[layer].name;
  throw Failure(ExitCode::BadShot,
                fmt::format("{}: output.maps: there is no map of the layer {}, and other programs need it; "
                            "write maps: all, or {} among them",
                            shot.file, in_quotes(name), in_quotes(name)));
}

Edge edge_of(const Layer& layer) {
  const auto* plate = std::get_if<PlateLayer>(&layer.kind);
  return plate ? plate->edge : Edge::Clamp;  // of what goes round the lookups end at the edge anyway
}

AlphaKind alpha_of(const LayerImage& image, const ImageOutline& outline) {
  if (outline.alpha.empty()) return AlphaKind::None;
  return image.alpha.value_or(outline.premultiplied ? AlphaKind::Associated : AlphaKind::Straight);
}

HandedLayer handed_layer(const Handoff& handoff, std::size_t index, const ColourConfig& colours) {
  const Shot& shot = handoff.shot;
  const Layer& layer = shot.layers[index];
  const LayerImage& image = layer.image;
  HandedLayer handed;
  handed.layer = index;
  handed.name = layer.name;
  handed.edge = edge_of(layer);
  handed.map = relative_to(shot.output.directory / fmt::format("{}.{}.map.####.exr", shot.name, layer.name),
                           handoff.folder);
  handed.image = relative_to(resolve_shipped(image.pattern.text), handoff.folder);
  std::optional<std::string> first;
  for (const int frame : handoff.frames) {
    const auto file = file_shown(image, frame);
    if (file && !first) handed.first_frame = frame;
    if (file && !first) first = file;
    handed.gains.push_back(
        std::exp2(value_at(layer.exposure, frame) + value_at(shot.camera.exposure, frame)));
    handed.files.push_back(file ? std::optional(relative_to(*file, handoff.folder)) : std::nullopt);
  }
  if (!first) throw Failure(ExitCode::BadInput, image.pattern.text + ": no frame of the shot has this image");
  handed.outline = read_outline(*first, image.choice);
  handed.alpha = alpha_of(image, handed.outline);
  handed.space = image.space ? image.space->text : colours.space_of_file(*first, read_interop_id(*first));
  handed.space_id = colours.interop_id(handed.space);
  return handed;
}

bool moves_in_exposure(const Handoff& handoff) {
  return std::any_of(handoff.frames.begin(), handoff.frames.end(),
                     [&](int frame) { return shutter_sampling(handoff.shot, frame).samples > 1; });
}

}  // namespace

Handoff hand_off(const Shot& shot, const std::vector<int>& frames, const std::filesystem::path& folder,
                 const ColourConfig& colours) {
  Handoff handoff{shot, frames, folder, {}, colours.interop_id(shot.colour.working.text), {}, {}, {}};
  std::vector<int> handed_at(shot.layers.size(), -1);
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    if (std::holds_alternative<StarsLayer>(shot.layers[k].kind)) continue;
    require_map(shot, k);
    handed_at[k] = static_cast<int>(handoff.layers.size());
    handoff.layers.push_back(
        located_in_shot(shot.layers[k].image.pattern, [&] { return handed_layer(handoff, k, colours); }));
  }
  if (handoff.layers.empty())
    throw Failure(ExitCode::BadShot,
                  shot.file + ": layers: only stars, of which there are no maps to hand on");
  if (!shot.lenses.empty() && shot.trace.shadow == HoleShadow::Opaque)
    handoff.shadow = relative_to(shot.output.directory / (shot.name + ".shadow.####.exr"), folder);
  for (const int frame : frames) {
    std::vector<int>& order = handoff.by_depth.emplace_back();
    for (const std::size_t k : depth_order(shot, frame)) order.push_back(handed_at[k]);
  }
  return handoff;
}

bool HandedLayer::has_gain() const {
  return std::any_of(gains.begin(), gains.end(), [](double gain) { return gain != 1.0; });
}

std::vector<std::string> left_out(const Handoff& handoff) {
  std::vector<std::string> words;
  const Shot& shot = handoff.shot;
  for (const Layer& layer : shot.layers) {
    if (std::holds_alternative<StarsLayer>(layer.kind)) words.push_back("the stars of " + layer.name);
    if (const auto* sphere = std::get_if<SphereLayer>(&layer.kind)) {
      if (sphere->light) words.push_back("the light on " + layer.name);
      if (sphere->night) words.push_back("the night of " + layer.name);
    }
    const auto* ring = std::get_if<RingLayer>(&layer.kind);
    if (ring && ring->shadow_of) words.push_back("the shadow on " + layer.name);
    const auto* plate = std::get_if<PlateLayer>(&layer.kind);
    const bool is_crossed_again = ring || (plate && plate->distance);
    if (is_crossed_again && !shot.lenses.empty())
      words.push_back("what is seen of " + layer.name + " through itself");
  }
  if (shot.camera.glow) words.push_back("glow");
  if (moves_in_exposure(handoff)) words.push_back("motion blur");
  return words;
}

std::optional<int> reordered_at(const Handoff& handoff) {
  for (std::size_t i = 0; i < handoff.frames.size(); ++i) {
    if (handoff.by_depth[i] != handoff.by_depth.front()) return handoff.frames[i];
  }
  return std::nullopt;
}

std::string relative_to(const std::filesystem::path& path, const std::filesystem::path& folder) {
  std::error_code error;
  const auto whole = [&error](const std::filesystem::path& p) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(p, error), error);
  };
  const std::filesystem::path relative = whole(path).lexically_relative(whole(folder));
  return relative.empty() ? whole(path).string() : relative.string();
}

MapScale scale_to_canvas(const PixelWindows& image, int left, int top, int width, int height) {
  MapScale map;
  map.scale[0] = static_cast<double>(image.display_width) / width;
  map.offset[0] = static_cast<double>(left - image.x) / width;
  // t is counted from below: a row y from the top of the canvas has t = 1 - y/height.
  map.scale[1] = static_cast<double>(image.display_height) / height;
  map.offset[1] = 1.0 - static_cast<double>(image.display_height - image.y + top) / height;
  return map;
}

FullSize full_size(const CameraTrack& camera) {
  const int margin = 2 * camera.overscan.value_or(0);
  return {camera.width + margin, camera.height + margin};
}

}  // namespace lensplane
