// SPDX-License-Identifier: Apache-2.0
//
// oiiotool's st_warp makes pictures of the size of the image that is looked up, reads the map pixel by pixel
// from the same corner, and finds nothing outside of the image. So every image is laid on a canvas that is at
// least as large as the map, the map is scaled to that canvas, and what comes out is cut to the map's size.

#include "pipeline/handoff/oiio_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipeline/image/frame_path.h"
#include "pipeline/image/version.h"

namespace lensplane {
namespace {

using Words = std::vector<std::string>;

void add(Words& words, std::initializer_list<std::string> more) {
  words.insert(words.end(), more);
}

std::string size_text(int width, int height, int x = 0, int y = 0) {
  return fmt::format("{}x{}{:+}{:+}", width, height, x, y);
}

/// The image in linear light in the working space, premultiplied, with the channels R, G, B, A.
void add_image(const HandedLayer& layer, const std::string& file, const std::string& working, Words& words) {
  // Otherwise oiiotool would premultiply colours as they are stored, of as many bits.
  if (layer.alpha == AlphaKind::Straight) add(words, {"--iconfig", "oiio:UnassociatedAlpha", "1"});
  words.push_back(file);
  if (layer.outline.part > 0) add(words, {"--subimage", std::to_string(layer.outline.part)});
  const auto& [red, green, blue] = layer.outline.colours;
  const std::string alpha = layer.alpha == AlphaKind::None ? "1" : layer.outline.alpha;
  add(words, {"--ch", fmt::format("R={},G={},B={},A={}", red, green, blue, alpha)});
  if (layer.space != working) {
    const bool divide = layer.alpha == AlphaKind::Associated;
    add(words, {divide ? "--colorconvert:unpremult=1" : "--colorconvert", layer.space, working});
  }
  if (layer.alpha == AlphaKind::Straight) add(words, {"--premult"});
}

/// A border that is transparent, for plates that end.
int border_of(const HandedLayer& layer) {
  return layer.edge == Edge::Black ? 1 : 0;
}

/// The layer as its map shows it, premultiplied by the map's coverage.
void add_layer(const Handoff& handoff, const HandedLayer& layer, std::size_t frame, Words& words) {
  const FullSize full = full_size(handoff.shot.camera);
  const PixelWindows& image = layer.outline.windows;
  const int border = border_of(layer);
  const int width = std::max(image.width + 2 * border, full.width),
            height = std::max(image.height + 2 * border, full.height);
  const std::string canvas = size_text(width, height), size = size_text(full.width, full.height);
  add_image(layer, *layer.files[frame], handoff.shot.colour.working.text, words);
  if (layer.gains[frame] != 1.0) add(words, {"--mulc", fmt::format("{0},{0},{0},1", layer.gains[frame])});
  add(words, {"--origin", fmt::format("+{}+{}", border, border), "--fullsize", canvas, "--crop", canvas});

  const std::string map = path_of_frame(layer.map, handoff.frames[frame]);
  const MapScale scale = scale_to_canvas(image, border, border, width, height);
  add(words, {map, "--ch", "R,G", "--origin", "+0+0", "--fullsize", size});
  add(words, {"--mulc", fmt::format("{},{}", scale.scale[0], scale.scale[1]), "--addc",
              fmt::format("{},{}", scale.offset[0], scale.offset[1])});
  if (border == 0) {
    // To the middles of the outermost pixels.
    const double left = 0.5 / width, right = (image.width - 0.5) / width;
    const double top = 1.0 - 0.5 / height, bottom = 1.0 - (image.height - 0.5) / height;
    add(words, {fmt::format("--clamp:min={},{}:max={},{}", left, bottom, right, top)});
  }
  add(words, {"--st_warp:filter=triangle:flip_t=1", "--crop", size, "--fullsize", size});
  add(words, {map, "--ch", "R=B,G=B,B=B,A=B", "--origin", "+0+0", "--fullsize", size, "--mul"});
}

/// Where light ends the picture is opaque; it is black there already.
void add_shadow(const Handoff& handoff, std::size_t frame, Words& words) {
  if (handoff.shadow.empty()) return;
  const FullSize full = full_size(handoff.shot.camera);
  add(words,
      {path_of_frame(handoff.shadow, handoff.frames[frame]), "--ch", "R=0,G=0,B=0,A=A", "--origin", "+0+0",
       "--fullsize", size_text(full.width, full.height), "--add", "--clamp:max=3e38,3e38,3e38,1"});
}

Words command_of(const Handoff& handoff, std::size_t frame, const std::string& output) {
  const CameraTrack& camera = handoff.shot.camera;
  const FullSize full = full_size(camera);
  Words words = {"oiiotool", "--colorconfig", handoff.config, "--create", size_text(full.width, full.height),
                 "4"};
  for (const int index : handoff.by_depth[frame]) {
    const HandedLayer& layer = handoff.layers[static_cast<std::size_t>(index)];
    if (!layer.files[frame]) continue;  // black
    add_layer(handoff, layer, frame, words);
    add(words, {"--swap", "--over"});
  }
  add_shadow(handoff, frame, words);
  const int overscan = camera.overscan.value_or(0);
  add(words, {"--origin", fmt::format("{:+}{:+}", -overscan, -overscan), "--fullsize",
              size_text(camera.width, camera.height), "--eraseattrib", ".*", "--nosoftwareattrib"});
  if (!handoff.working_id.empty()) add(words, {"--sattrib", "colorInteropID", handoff.working_id});
  add(words, {"-d", handoff.shot.output.image.type == PixelType::Half ? "half" : "float", "-o",
              path_of_frame(output, handoff.frames[frame])});
  return words;
}

}  // namespace

std::string oiio_commands(const Handoff& handoff) {
  using nlohmann::json;
  const std::string output = handoff.shot.name + ".oiio.####.exr";
  json frames = json::array();
  for (std::size_t i = 0; i < handoff.frames.size(); ++i)
    frames.push_back({{"frame", handoff.frames[i]}, {"commands", {command_of(handoff, i, output)}}});
  const json all = {{"lensplane", kVersion},
                    {"shot", handoff.shot.name},
                    {"output", output},
                    {"frames", std::move(frames)}};
  return all.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::vector<std::string> left_out_by_oiiotool(const Handoff& handoff) {
  std::vector<std::string> words;
  for (const HandedLayer& layer : handoff.layers) {
    const bool goes_on = layer.edge == Edge::Mirror || layer.edge == Edge::Repeat;
    if (goes_on) words.push_back("what lies outside of " + layer.name + " (its outermost pixels go on)");
  }
  return words;
}

}  // namespace lensplane
