// SPDX-License-Identifier: Apache-2.0

#include "pipeline/handoff/blender_script.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "pipeline/colour/interop_spaces.h"
#include "pipeline/image/frame_path.h"

namespace lensplane {
namespace {

/// What works for every shot; what is this shot's stands before it, in SHOT.
constexpr const char* kProgram = R"PY(
HERE = os.path.dirname(os.path.abspath(__file__))


def set_space(settings, names):
    """The first of several names of a colour space that Blender's OCIO config knows."""
    for name in names:
        try:
            settings.name = name
            return
        except TypeError:
            pass
    raise SystemExit("%s: no colour space of Blender's OCIO config; set OCIO=%s" % (names[0], SHOT["config"]))


scene = bpy.context.scene
scene.frame_start, scene.frame_end = SHOT["frames"]
scene.frame_step = SHOT["step"]
scene.render.fps, scene.render.fps_base = SHOT["fps"]
scene.render.resolution_x, scene.render.resolution_y = SHOT["resolution"]
scene.render.resolution_percentage = 100
scene.render.use_compositing = True
scene.render.use_sequencer = False
scene.render.dither_intensity = 0
scene.render.filepath = os.path.join(HERE, SHOT["output"])
output = scene.render.image_settings
output.file_format = "OPEN_EXR"  # scene-linear: no view transform is applied
output.color_mode = "RGBA"
output.color_depth = SHOT["depth"]
output.exr_codec = "ZIP"
output.color_management = "OVERRIDE"
set_space(output.linear_colorspace_settings, SHOT["working"])

scene.use_nodes = True
tree = scene.node_tree
tree.nodes.clear()


def node(kind, column, row, **values):
    made = tree.nodes.new("CompositorNode" + kind)
    made.location = (column * 260, -row * 320)
    for name, value in values.items():
        setattr(made, name, value)
    return made


def image_node(file, names, alpha, first, column, row):
    path = os.path.normpath(os.path.join(HERE, file))
    if not os.path.exists(path):
        raise SystemExit(path + ": no such image; lensplane map makes the maps")
    image = bpy.data.images.load(path)
    set_space(image.colorspace_settings, names)
    image.alpha_mode = alpha
    made = node("Image", column, row, image=image)
    if first is not None:
        image.source = "SEQUENCE"
        made.frame_start = scene.frame_start
        made.frame_duration = scene.frame_end - scene.frame_start + 1
        made.frame_offset = first - 1
        made.use_auto_refresh = True
    return made


def exposed(layer, picture, row):
    """The layer's light by its exposure at every frame."""
    if layer["gains"] is None:
        return picture
    made = node("MixRGB", 3, row + 0.75, blend_type="MULTIPLY")
    tree.links.new(picture, made.inputs[1])
    for frame, gain in layer["gains"]:
        made.inputs[2].default_value = (gain, gain, gain, 1)
        made.inputs[2].keyframe_insert("default_value", frame=frame)
    return made.outputs[0]


def layer_image(layer, row):
    """The layer's image, premultiplied. Image nodes give straight alpha as it is: it is multiplied here."""
    if layer["alpha"] != "STRAIGHT":
        return image_node(layer["image"], layer["spaces"], layer["alpha"], layer["first"], 2, row).outputs["Image"]
    colours = image_node(layer["image"], layer["spaces"], "NONE", layer["first"], 2, row)
    alpha = image_node(layer["image"], layer["spaces"], "STRAIGHT", layer["first"], 2, row + 0.5)
    joined = node("SetAlpha", 3, row, mode="APPLY")
    tree.links.new(colours.outputs["Image"], joined.inputs["Image"])
    tree.links.new(alpha.outputs["Alpha"], joined.inputs["Alpha"])
    return joined.outputs["Image"]


def math(operation, value, numbers, column, row):
    made = node("Math", column, row, operation=operation)
    tree.links.new(value, made.inputs[0])
    for i, number in enumerate(numbers):
        made.inputs[i + 1].default_value = number
    return made.outputs[0]


def leads_to(layer, uv, row):
    """(s, t) of the map as Map UV takes it: shares of the whole file, led back into it where the image goes on."""
    parts = node("SeparateColor", 1, row)
    tree.links.new(uv, parts.inputs[0])
    joined = node("CombineColor", 3, row)
    for i in range(2):
        value = parts.outputs[i]
        value = math("MULTIPLY_ADD", value, (layer["scale"][i], layer["offset"][i]), 2, row)
        for operation, numbers in layer["edge"]:
            value = math(operation, value, numbers, 2, row)
        for operation, bounds in layer["bounds"]:
            value = math(operation, value, (bounds[i],), 2, row)
        tree.links.new(value, joined.inputs[i])
    tree.links.new(parts.outputs[2], joined.inputs[2])
    return joined.outputs[0]


picture = None
for row, layer in enumerate(SHOT["layers"]):  # farthest first
    uv = image_node(layer["map"], ["Non-Color", "Raw"], "NONE", scene.frame_start, 0, row)
    source = exposed(layer, layer_image(layer, row + 0.5), row + 0.5)
    looked_up = node("MapUV", 4, row, alpha=0)
    tree.links.new(source, looked_up.inputs["Image"])
    tree.links.new(leads_to(layer, uv.outputs["Image"], row), looked_up.inputs["UV"])
    if picture is None:
        picture = looked_up.outputs[0]
        continue
    over = node("AlphaOver", 5, row)
    tree.links.new(picture, over.inputs[1])
    tree.links.new(looked_up.outputs[0], over.inputs[2])
    picture = over.outputs[0]
if SHOT["shadow"] is not None:  # where light ends: black already, and opaque
    shadow = image_node(SHOT["shadow"], ["Non-Color", "Raw"], "NONE", scene.frame_start, 5, len(SHOT["layers"]))
    parts = [node("SeparateColor", 6, len(SHOT["layers"]) + i) for i in range(2)]
    tree.links.new(picture, parts[0].inputs[0])
    tree.links.new(shadow.outputs["Image"], parts[1].inputs[0])
    alpha = node("Math", 7, len(SHOT["layers"]), operation="ADD", use_clamp=True)
    tree.links.new(parts[0].outputs[3], alpha.inputs[0])
    tree.links.new(parts[1].outputs[0], alpha.inputs[1])
    opaque = node("SetAlpha", 8, len(SHOT["layers"]), mode="REPLACE_ALPHA")
    tree.links.new(picture, opaque.inputs["Image"])
    tree.links.new(alpha.outputs[0], opaque.inputs["Alpha"])
    picture = opaque.outputs[0]
tree.links.new(picture, node("Composite", 9, len(SHOT["layers"]) - 1).inputs["Image"])
)PY";

/// A colour space as configs call it: the shot's, and Blender's own.
nlohmann::json names_of(const std::string& space, const std::string& id) {
  nlohmann::json names = {space};
  const InteropSpace* known = interop_space_of(id);
  if (!known) return names;
  for (const char* name : known->names) names.push_back(name);
  names.push_back(known->id);
  if (id == "lin_ap1_scene") names.push_back("Linear ACEScg");
  if (id == "lin_ap0_scene") names.push_back("Linear ACES");
  if (id == "lin_rec709_scene") names.push_back("Linear Rec.709");
  if (id == "lin_rec709_scene") names.push_back("Linear");
  if (id == "srgb_rec709_scene") names.push_back("sRGB");
  return names;
}

std::string alpha_mode(AlphaKind alpha) {
  if (alpha == AlphaKind::None) return "NONE";
  return alpha == AlphaKind::Straight ? "STRAIGHT" : "PREMUL";
}

/// Blender's operations that lead s and t, one at a time, back into an image that goes on outside.
nlohmann::json edge_operations(Edge edge) {
  using nlohmann::json;
  if (edge == Edge::Repeat) return json::array({{"WRAP", {1, 0}}});
  if (edge == Edge::Mirror) return json::array({{"PINGPONG", json::array({1})}});
  return json::array();
}

/// The middles of the outermost pixels: Blender finds nothing beyond them.
nlohmann::json bounds_of(const HandedLayer& layer) {
  using nlohmann::json;
  if (layer.edge == Edge::Black) return json::array();
  const double s = 0.5 / layer.outline.windows.width, t = 0.5 / layer.outline.windows.height;
  return json::array({{"MAXIMUM", {s, t}}, {"MINIMUM", {1 - s, 1 - t}}});
}

/// Pairs of frame and gain; nothing without an exposure.
nlohmann::json gains_of(const Handoff& handoff, const HandedLayer& layer) {
  if (!layer.has_gain()) return {};
  nlohmann::json gains = nlohmann::json::array();
  for (std::size_t i = 0; i < layer.gains.size(); ++i) gains.push_back({handoff.frames[i], layer.gains[i]});
  return gains;
}

nlohmann::json layer_data(const Handoff& handoff, const HandedLayer& layer) {
  const LayerImage& image = handoff.shot.layers[layer.layer].image;
  if (!image.choice.layer.empty() || !image.choice.part.empty()) {
    refuse(image.pattern.location, image.pattern.key,
           "a layer or part of a file, which this script cannot choose; allowed: a file of its own, or --to "
           "oiio");
  }
  const PixelWindows& windows = layer.outline.windows;
  const MapScale scale = scale_to_canvas(windows, 0, 0, windows.width, windows.height);
  return {{"name", layer.name},
          {"map", path_of_frame(layer.map, handoff.frames.front())},
          {"image", path_of_frame(layer.image, layer.first_frame)},
          {"first", is_sequence(layer.image) ? nlohmann::json(handoff.frames.front()) : nlohmann::json()},
          {"spaces", names_of(layer.space, layer.space_id)},
          {"alpha", alpha_mode(layer.alpha)},
          {"edge", edge_operations(layer.edge)},
          {"scale", scale.scale},
          {"offset", scale.offset},
          {"bounds", bounds_of(layer)},
          {"gains", gains_of(handoff, layer)}};
}

/// The largest step that meets all frames.
int step_of(const std::vector<int>& frames) {
  int step = 0;
  for (const int frame : frames) step = std::gcd(step, frame - frames.front());
  return std::max(1, step);
}

}  // namespace

std::string blender_script(const Handoff& handoff) {
  const Shot& shot = handoff.shot;
  const FullSize full = full_size(shot.camera);
  nlohmann::json layers = nlohmann::json::array();
  for (const int index : handoff.by_depth.front())
    layers.push_back(layer_data(handoff, handoff.layers[static_cast<std::size_t>(index)]));
  const nlohmann::json data = {
      {"frames", {handoff.frames.front(), handoff.frames.back()}},
      {"step", step_of(handoff.frames)},
      {"fps", {shot.fps.numerator, shot.fps.denominator}},
      {"resolution", {full.width, full.height}},
      {"output", shot.name + ".blender.####.exr"},
      {"depth", shot.output.image.type == PixelType::Half ? "16" : "32"},
      {"config", handoff.config},
      {"working", names_of(shot.colour.working.text, handoff.working_id)},
      {"layers", layers},
      {"shadow", handoff.shadow.empty()
                     ? nlohmann::json()
                     : nlohmann::json(path_of_frame(handoff.shadow, handoff.frames.front()))},
  };
  const std::string text = data.dump(1, ' ', true, nlohmann::json::error_handler_t::replace);
  // JSON has never three quotes in a row, and no backslash at its end.
  return fmt::format(
             "# Made by lensplane: the maps of the shot {0} in Blender's compositor (3.4 to 4).\n"
             "#   blender --background --factory-startup --python {0}.blender.py -a          all frames\n"
             "#   blender --background --factory-startup --python {0}.blender.py -f {1}       one, or "
             "several: 1,2,5\n"
             "# writes {0}.blender.####.exr beside this file. With OCIO={2} Blender works in the shot's own "
             "spaces.\n"
             "# The layers' order is that of frame {1}. Left out: {3}.\n"
             "import json\nimport os\n\nimport bpy\n\nSHOT = json.loads(r\"\"\"{4}\"\"\")\n",
             shot.name, handoff.frames.front(), handoff.config,
             left_out(handoff).empty() ? "nothing" : fmt::format("{}", fmt::join(left_out(handoff), ", ")),
             text) +
         kProgram;
}

}  // namespace lensplane
