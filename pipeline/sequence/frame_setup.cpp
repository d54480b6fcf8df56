// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/frame_setup.h"

#include <algorithm>

#include "pipeline/image/display_writer.h"
#include "pipeline/sequence/fingerprint.h"
#include "pipeline/sequence/map_layers.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/sequence/shot_colours.h"
#include "pipeline/sequence/shot_glow.h"
#include "pipeline/sequence/shutter.h"
#include "pipeline/shot/shot_scene.h"
#include "src/plan_words.h"

namespace lensplane {
namespace {

/// What the frame rate, the working space and the plan's line are determines no number of a map, but its
/// header says them.
Fingerprint fingerprint_of_film(const Shot& shot, const ColourConfig& colours, const Scene& scene,
                                const Plan& plan) {
  return fingerprint_of_trace(scene, plan)
      .add(describe(plan))
      .add(shot.fps.numerator)
      .add(shot.fps.denominator)
      .add(colours.interop_id(shot.colour.working.text));
}

/// A coverage of whole pixels is what maps without a choice had.
Fingerprint fingerprint_of_map(const Shot& shot, const ColourConfig& colours, const Scene& scene,
                               const Plan& plan) {
  Fingerprint print = fingerprint_of_film(shot, colours, scene, plan);
  if (shot.output.coverage == Coverage::Filtered) print.add("filtered coverage");
  return print;
}

Fingerprint fingerprint_of_data(const Shot& shot, const ColourConfig& colours, const Scene& scene,
                                const Plan& plan) {
  Fingerprint print = fingerprint_of_map(shot, colours, scene, plan);
  print.add("data");
  for (const EffectName& entry : kEffectNames) print.add(plan.effects.*entry.effect);
  return print;
}

/// What the picture shows at a moment, but for its images.
void add_moment(const Shot& shot, const Moment& moment, Fingerprint& print) {
  const double time = moment.time;
  const Scene scene = scene_at(shot, time);
  TraceSettings settings = trace_at(shot, time);
  settings.effects = {};
  print.add(fingerprint_of_trace(scene, plan_trace(scene, settings)).digest());
  print.add(moment.sampling.max).add(moment.sampling.threshold).add(moment.sampling.first);
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    const double exposure = value_at(shot.layers[k].exposure, time);
    if (exposure != 0) print.add("exposure").add(static_cast<double>(k)).add(exposure);
    if (const auto light = light_at(shot.layers[k], time)) print.add("light").add(*light);
    if (const double sun = sun_at(shot.layers[k], time); sun > 0) print.add("sun").add(sun);
    if (const auto shadow = shadow_at(shot, k, time)) {
      if (shadow->sun > 0) print.add("penumbra").add(shadow->sun);
      print.add("shadow").add(shadow->light).add(shadow->sphere.centre).add(shadow->sphere.radius);
    }
    if (const auto* stars = std::get_if<StarsLayer>(&shot.layers[k].kind)) {
      print.add("stars").add(value_at(stars->exposure, time)).add(value_at(stars->rotation, time));
    }
  }
}

std::string fingerprint_of_picture(const Shot& shot, const ColourConfig& colours, TextureStore& textures,
                                   int frame, const FrameSetup& setup) {
  Fingerprint print;
  print.add(fingerprint_of_film(shot, colours, setup.scene, setup.plan).digest())
      .add(shot.colour.working.text);
  print.add(static_cast<double>(shot.output.image.type))
      .add(static_cast<double>(shot.output.image.compression));
  for (std::size_t k = 0; k < shot.layers.size(); ++k) print.add(textures.digest(k, frame));
  for (const Moment& moment : moments_of(shot, frame)) add_moment(shot, moment, print);
  const double exposure = value_at(shot.camera.exposure, frame);
  if (exposure != 0) print.add("camera exposure").add(exposure);
  if (!shot.lenses.empty()) print.add("shadow").add(static_cast<double>(shot.trace.shadow));
  if (const auto glow = glow_at(shot, frame)) print.add("veil").add(glow->strength).add(glow->radius_px);
  return print.digest();
}

std::string fingerprint_of_review(const Shot& shot, const ColourConfig& colours, int frame,
                                  const FrameSetup& setup) {
  return Fingerprint()
      .add(setup.picture_header.parameters)
      .add(colours.view_id(view_of(shot)))
      .add(static_cast<double>(shot.output.locator))
      .add(value_at(shot.output.review_exposure, frame))
      .digest();
}

ExrHeader common_header(const Shot& shot, const ColourConfig& colours, int frame, const Scene& scene,
                        const Plan& plan) {
  ExrHeader header;
  header.shot = shot.name;
  header.frame = frame;
  header.plan = describe(plan);
  header.fps = shot.fps;
  header.camera_axes = scene.camera.axes;
  header.camera_position = scene.camera.position;
  header.chromaticities = colours.chromaticities(shot.colour.working.text);
  return header;
}

bool exr_is_done(const std::filesystem::path& path, const ExrHeader& header) {
  return read_exr_attribute(path, "parameters") == header.parameters;
}

/// The scene of the frame, how it is traced, and what the files of its maps say.
FrameSetup set_up_trace(const Shot& shot, const ColourConfig& colours, int frame) {
  FrameSetup setup;
  setup.scene = scene_at(shot, frame);
  TraceSettings settings = trace_at(shot, frame);
  const auto header = [&](const Plan& plan, const Fingerprint& print) {
    ExrHeader header = common_header(shot, colours, frame, setup.scene, plan);
    header.colour_interop = "data";
    header.parameters = print.digest();
    return header;
  };
  if (settings.effects.any()) {
    setup.data_plan = plan_trace(setup.scene, settings);
    setup.data_header =
        header(setup.data_plan, fingerprint_of_data(shot, colours, setup.scene, setup.data_plan));
  }
  settings.effects = {};
  setup.plan = plan_trace(setup.scene, settings);
  setup.map_header = header(setup.plan, fingerprint_of_map(shot, colours, setup.scene, setup.plan));
  setup.shadow_header = setup.map_header;
  setup.shadow_header.parameters = Fingerprint().add(setup.map_header.parameters).add("shadow").digest();
  return setup;
}

}  // namespace

FrameSetup set_up_frame(const Shot& shot, const ColourConfig& colours, TextureStore& textures, int frame,
                        const FrameTasks& tasks) {
  FrameSetup setup = set_up_trace(shot, colours, frame);
  for (std::size_t k = 0; tasks.maps && k < shot.layers.size(); ++k) {
    if (!shot.output.maps[k]) continue;
    const std::string& layer = shot.layers[k].name;
    if (tasks.redo || !exr_is_done(map_path(shot, layer, frame), setup.map_header)) setup.maps.push_back(k);
    if (!shot.output.data.any()) continue;
    if (tasks.redo || !exr_is_done(data_path(shot, layer, frame), setup.data_header)) setup.data.push_back(k);
  }
  const bool any_map =
      std::find(shot.output.maps.begin(), shot.output.maps.end(), true) != shot.output.maps.end();
  setup.shadow = tasks.maps && any_map && !shot.lenses.empty() &&
                 (tasks.redo || !exr_is_done(shadow_path(shot, frame), setup.shadow_header));
  if (!tasks.picture) return setup;
  setup.picture_header = common_header(shot, colours, frame, setup.scene, setup.plan);
  setup.picture_header.colour_interop = colours.interop_id(shot.colour.working.text);
  setup.picture_header.parameters = fingerprint_of_picture(shot, colours, textures, frame, setup);
  if (tasks.from_maps) {
    setup.picture_header.plan = "from maps";
    setup.picture_header.parameters =
        Fingerprint().add(setup.picture_header.parameters).add(digest_of_maps(shot, frame)).digest();
  }
  if (shot.output.review) setup.review_parameters = fingerprint_of_review(shot, colours, frame, setup);
  const auto review_done = [&] {
    return !shot.output.review ||
           read_display_parameters(review_path(shot, frame)) == setup.review_parameters;
  };
  setup.picture =
      tasks.redo || !exr_is_done(picture_path(shot, frame), setup.picture_header) || !review_done();
  return setup;
}

}  // namespace lensplane
