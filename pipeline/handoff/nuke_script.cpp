// SPDX-License-Identifier: Apache-2.0
//
// Nuke reads a script as a stack: a node takes its inputs from the top (the last one pushed is input 0) and
// is pushed itself. Merge2 lays input 1, A, over input 0, B: with the nearest layer first, each merge finds
// what is nearer below, and the next layer on top.

#include "pipeline/handoff/nuke_script.h"

#include <fmt/format.h>

#include "pipeline/image/frame_path.h"

namespace lensplane {
namespace {

// Positions of nodes in Nuke's graph, in its units.
constexpr int kColumn = 220, kRow = 60;

/// `text` between quotes, with nothing for Tcl to evaluate.
std::string tcl_text(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (std::string_view("\\\"[]{}$").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result + '"';
}

/// A path for a knob that Nuke evaluates once more when it reads the file.
std::string tcl_path(const std::string& path) {
  std::string knob;
  for (const char c : path) {
    if (std::string_view("\\[$").find(c) != std::string_view::npos) knob += '\\';
    knob += c;
  }
  return tcl_text(knob);
}

struct Place {
  int column, row;
};

std::string node(const std::string& kind, const std::string& knobs, Place place) {
  return fmt::format("{} {{\n{} xpos {}\n ypos {}\n}}\n", kind, knobs, place.column * kColumn,
                     place.row * kRow);
}

std::string root(const Handoff& handoff) {
  const Shot& shot = handoff.shot;
  return fmt::format(
      "Root {{\n inputs 0\n first_frame {}\n last_frame {}\n lock_range true\n fps {}\n"
      " format \"{} {} 0 0 {} {} 1 {}\"\n project_directory \"\\[python "
      "\\{{nuke.script_directory()\\}}]\"\n}}\n",
      handoff.frames.front(), handoff.frames.back(),
      static_cast<double>(shot.fps.numerator) / shot.fps.denominator, shot.camera.width, shot.camera.height,
      shot.camera.width, shot.camera.height, "lensplane_" + shot.name);
}

std::string note(const Handoff& handoff) {
  std::string text = "Made by lensplane from the shot " + handoff.shot.name +
                     ".\nMaps are raw data: no colour space, no filter, no resize before STMap.\n"
                     "The layers' order is that of frame " +
                     std::to_string(handoff.frames.front()) + ".\n";
  if (const auto frame = reordered_at(handoff))
    text += fmt::format("At frame {} it changes: animate the merges there.\n", *frame);
  text += "Working space: " + handoff.shot.colour.working.text + "; OCIO config: " + handoff.config + "\n";
  for (const HandedLayer& layer : handoff.layers) text += layer.name + " is " + layer.space + "\n";
  text += "STMap filters across the seam of skies and globes, where s jumps from 1 to 0: one pixel wide.\n";
  if (!left_out(handoff).empty()) text += fmt::format("Left out: {}\n", fmt::join(left_out(handoff), ", "));
  text.pop_back();
  return node("StickyNote", fmt::format(" inputs 0\n name note\n label {}\n", tcl_text(text)), {-2, 0});
}

std::string read(const Handoff& handoff, const std::string& name, const std::string& path,
                 const std::string& more, Place place) {
  std::string range;
  if (is_sequence(path)) {
    range = fmt::format(" first {0}\n last {1}\n origfirst {0}\n origlast {1}\n", handoff.frames.front(),
                        handoff.frames.back());
  }
  return node("Read", fmt::format(" inputs 0\n file {}\n{}{} name {}\n", tcl_path(path), range, more, name),
              place);
}

/// How (s, t) outside of the image lead back into it; empty where they need not.
std::string edge_node(const HandedLayer& layer, Place place) {
  const auto expression = [&](const char* of_r, const char* of_g) {
    return node(
        "Expression",
        fmt::format(" expr0 {}\n expr1 {}\n name edge_{}\n", tcl_text(of_r), tcl_text(of_g), layer.name),
        place);
  };
  if (layer.edge == Edge::Repeat) return expression("r-floor(r)", "g-floor(g)");
  if (layer.edge == Edge::Mirror) return expression("1-abs(1-(r-2*floor(r/2)))", "1-abs(1-(g-2*floor(g/2)))");
  return {};  // Nuke goes on with the outermost pixels by itself
}

/// The exposure of a layer, at every frame.
std::string exposure_node(const Handoff& handoff, const HandedLayer& layer, Place place) {
  if (!layer.has_gain()) return {};
  std::string curve;
  for (std::size_t i = 0; i < layer.gains.size(); ++i)
    curve += fmt::format(" x{} {}", handoff.frames[i], layer.gains[i]);
  return node("Multiply",
              fmt::format(" channels rgb\n value {{{{curve{}}}}}\n name exposure_{}\n", curve, layer.name),
              place);
}

/// What makes the image premultiplied, and transparent outside where it ends.
std::string image_nodes(const Handoff& handoff, const HandedLayer& layer, int column) {
  const Missing missing = handoff.shot.layers[layer.layer].image.missing;
  std::string more;
  if (missing == Missing::Black) more += " on_error black\n";
  if (missing == Missing::Hold) more += " on_error \"nearest frame\"\n";
  if (layer.alpha == AlphaKind::None) more += " auto_alpha true\n";
  std::string text = read(handoff, "image_" + layer.name, layer.image, more, {column, 0});
  // Not all of an alpha that is there, but to be ignored.
  const bool ignored = layer.alpha == AlphaKind::None && !layer.outline.alpha.empty();
  if (ignored)
    text += node("Shuffle", fmt::format(" alpha white\n name opaque_{}\n", layer.name), {column, 2});
  if (layer.alpha == AlphaKind::Straight)
    text += node("Premult", fmt::format(" name premult_{}\n", layer.name), {column, 2});
  text += exposure_node(handoff, layer, {column, 2});
  if (layer.edge == Edge::Black)
    text += node("BlackOutside", fmt::format(" name outside_{}\n", layer.name), {column, 3});
  return text;
}

std::string layer_nodes(const Handoff& handoff, const HandedLayer& layer, int column) {
  const std::string& name = layer.name;
  std::string text = read(handoff, "map_" + name, layer.map, " raw true\n", {column + 1, 0});
  text += fmt::format("set Nmap_{} [stack 0]\n", name);
  text += node("Shuffle",
               fmt::format(" red blue\n green blue\n blue blue\n alpha blue\n name coverage_{}\n", name),
               {column + 1, 4});
  text += fmt::format("push $Nmap_{}\n", name);
  text += edge_node(layer, {column + 1, 2});
  text += image_nodes(handoff, layer, column);
  text +=
      node("STMap", fmt::format(" inputs 2\n channels rgba\n uv rgb\n name stmap_{}\n", name), {column, 4});
  return text +
         node("Merge2", fmt::format(" inputs 2\n operation mask\n name covered_{}\n", name), {column, 5});
}

/// Where light ends the picture is opaque; it is black there already.
std::string shadow_nodes(const Handoff& handoff, int column, int row) {
  if (handoff.shadow.empty()) return {};
  return read(handoff, "shadow", handoff.shadow, " raw true\n", {column + 1, 0}) +
         node("Shuffle", " red black\n green black\n blue black\n name black\n", {column + 1, row}) +
         node("Merge2", " inputs 2\n operation plus\n name opaque\n", {column, row}) +
         node("Clamp", " channels alpha\n name full\n", {column, row + 1});
}

void require_plain_image(const Handoff& handoff, const HandedLayer& layer) {
  const LayerImage& image = handoff.shot.layers[layer.layer].image;
  if (image.choice.layer.empty() && image.choice.part.empty()) return;
  refuse(image.pattern.location, image.pattern.key,
         "a layer or part of a file, which this script cannot choose; allowed: a file of its own, or --to "
         "oiio");
}

}  // namespace

std::string nuke_script(const Handoff& handoff) {
  std::string text = "#! lensplane\nversion 12.0 v1\n" + root(handoff) + note(handoff);
  const std::vector<int>& order = handoff.by_depth.front();
  int column = 0;
  const int below = 7;
  for (auto nearest = order.rbegin(); nearest != order.rend(); ++nearest, ++column) {
    const HandedLayer& layer = handoff.layers[static_cast<std::size_t>(*nearest)];
    require_plain_image(handoff, layer);
    text += layer_nodes(handoff, layer, 2 * column);
    if (column > 0)
      text += node("Merge2", fmt::format(" inputs 2\n operation over\n name over_{}\n", layer.name),
                   {2 * column, below});
  }
  text += shadow_nodes(handoff, 2 * column - 2, below + 1);
  return text +
         node("Write",
              fmt::format(
                  " file {}\n file_type exr\n datatype {}\n channels rgba\n create_directories "
                  "true\n name write\n",
                  tcl_path(handoff.shot.name + ".nuke.####.exr"),
                  handoff.shot.output.image.type == PixelType::Half ? "\"16 bit half\"" : "\"32 bit float\""),
              {2 * column - 2, below + 3});
}

}  // namespace lensplane
