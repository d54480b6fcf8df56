// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/frame_setup.h"

#include "pipeline/image/png_writer.h"
#include "pipeline/sequence/fingerprint.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

/// The frame rate and the working space determine no number of a map, but its header says them.
std::string fingerprint_of_map(const Shot& shot, const ColourConfig& colours, const FrameSetup& setup) {
  return fingerprint_of_trace(setup.scene, setup.plan)
      .add(shot.fps.numerator)
      .add(shot.fps.denominator)
      .add(colours.interop_id(shot.colour.working.text))
      .digest();
}

std::string fingerprint_of_picture(const Shot& shot, TextureStore& textures, int frame,
                                   const FrameSetup& setup) {
  Fingerprint print;
  print.add(setup.map_header.parameters).add(shot.colour.working.text);
  print.add(static_cast<double>(shot.output.image.type))
      .add(static_cast<double>(shot.output.image.compression));
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    print.add(textures.digest(k, frame));
    if (const auto light = light_at(shot.layers[k], frame)) print.add("light").add(*light);
  }
  return print.digest();
}

std::string fingerprint_of_review(const Shot& shot, const ColourConfig& colours, const FrameSetup& setup) {
  const ColourSettings& colour = shot.colour;
  return Fingerprint()
      .add(setup.picture_header.parameters)
      .add(colours.view_id(colour.working.text, colour.display.text, colour.view.text))
      .add(static_cast<double>(shot.output.locator))
      .digest();
}

ExrHeader common_header(const Shot& shot, const ColourConfig& colours, int frame, const FrameSetup& setup) {
  ExrHeader header;
  header.shot = shot.name;
  header.frame = frame;
  header.plan = describe(setup.plan);
  header.fps = shot.fps;
  header.camera_axes = setup.scene.camera.axes;
  header.camera_position = setup.scene.camera.position;
  header.chromaticities = colours.chromaticities(shot.colour.working.text);
  return header;
}

bool exr_is_done(const std::filesystem::path& path, const ExrHeader& header) {
  return read_exr_attribute(path, "parameters") == header.parameters;
}

}  // namespace

FrameSetup set_up_frame(const Shot& shot, const ColourConfig& colours, TextureStore& textures, int frame,
                        const FrameTasks& tasks) {
  FrameSetup setup;
  setup.scene = scene_at(shot, frame);
  setup.plan = plan_trace(setup.scene, shot.method);
  setup.map_header = common_header(shot, colours, frame, setup);
  setup.map_header.colour_interop = "data";
  setup.map_header.parameters = fingerprint_of_map(shot, colours, setup);
  for (std::size_t k = 0; tasks.maps && k < shot.layers.size(); ++k) {
    if (!shot.output.maps[k]) continue;
    if (tasks.redo || !exr_is_done(map_path(shot, shot.layers[k].name, frame), setup.map_header))
      setup.maps.push_back(k);
  }
  if (!tasks.picture) return setup;
  setup.picture_header = common_header(shot, colours, frame, setup);
  setup.picture_header.colour_interop = colours.interop_id(shot.colour.working.text);
  setup.picture_header.parameters = fingerprint_of_picture(shot, textures, frame, setup);
  if (shot.output.review) setup.review_parameters = fingerprint_of_review(shot, colours, setup);
  const bool picture_done = exr_is_done(picture_path(shot, frame), setup.picture_header);
  const bool review_done =
      !shot.output.review || read_png_parameters(review_path(shot, frame)) == setup.review_parameters;
  setup.picture = tasks.redo || !picture_done || !review_done;
  return setup;
}

}  // namespace lensplane
