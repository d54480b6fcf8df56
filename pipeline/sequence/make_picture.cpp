// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/make_picture.h"

#include "pipeline/composite/compositor.h"
#include "pipeline/composite/glow.h"
#include "pipeline/composite/map_composite.h"
#include "pipeline/sequence/make_review.h"
#include "pipeline/sequence/map_layers.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/sequence/shot_glow.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

/// What the surfaces of the scene look like at a time, with the images of its frame.
std::vector<SurfaceLook> load_looks(const Shot& shot, const Scene& scene, TextureStore& textures, int frame,
                                    double time, FrameReport& report) {
  std::vector<SurfaceLook> looks;
  for (std::size_t k = 0; k < shot.layers.size(); ++k) {
    SurfaceLook look;
    look.texture = timed(report[Phase::Load].seconds, [&] { return textures.texture(k, frame); });
    report[Phase::Load].bytes += look.texture->picture().pixels.size() * sizeof(Rgba);
    if (const auto light = light_at(shot.layers[k], time)) {
      look.light = std::get<Sphere>(scene.surfaces[k]).axes.local_from_parent(*light);
    }
    looks.push_back(std::move(look));
  }
  return looks;
}

/// The picture of one instant.
Composite take_instant(const Shot& shot, const Scene& scene, TextureStore& textures, int frame, double time,
                       const Sampling& sampling, FrameReport& report) {
  const auto looks = load_looks(shot, scene, textures, frame, time, report);
  TraceSettings settings = trace_at(shot, time);
  settings.effects = {};
  settings.effects.jacobian = true;
  const Tracer tracer(scene, plan_trace(scene, settings));
  Composite instant =
      timed(report[Phase::Composite].seconds, [&] { return composite(tracer, looks, sampling); });
  report.rays += instant.rays;
  return instant;
}

void write_picture(const Shot& shot, int frame, const FrameSetup& setup, const Picture& picture,
                   FrameReport& report) {
  ExrHeader header = setup.picture_header;
  header.amplification = text_from_amplifications(report.amplifications);
  const Camera& camera = setup.scene.camera;
  std::vector<ExrChannel> channels;
  for (const char* name : {"R", "G", "B", "A"}) {
    channels.push_back({name, picture.pixels.front().data() + channels.size(), 4});
  }
  report[Phase::Write].bytes += timed(report[Phase::Write].seconds, [&] {
    return write_exr(picture_path(shot, frame), {camera.width, camera.height, camera.overscan}, channels,
                     shot.output.image, header);
  });
}

Picture composite_of_maps(const Shot& shot, int frame, const FrameSetup& setup,
                          const std::vector<SurfaceLook>& looks, FrameReport& report) {
  const auto layers =
      timed(report[Phase::Load].seconds, [&] { return load_map_layers(shot, setup.scene, looks, frame); });
  return timed(report[Phase::Composite].seconds, [&] { return composite_from_maps(layers); });
}

}  // namespace

void make_picture(const Shot& shot, const ColourConfig& colours, TextureStore& textures, int frame,
                  const FrameTasks& tasks, const FrameSetup& setup, FrameReport& report) {
  const auto looks = load_looks(shot, setup.scene, textures, frame, frame, report);
  Picture picture;
  if (tasks.from_maps) {
    picture = composite_of_maps(shot, frame, setup, looks, report);
  } else {
    Composite result = take_instant(shot, setup.scene, textures, frame, frame, {}, report);
    report.amplifications = timed(report[Phase::Trace].seconds, [&] {
      return amplifications_of(shot, setup.scene, setup.plan.method, {}, result.hits);
    });
    picture = std::move(result.picture);
  }
  report[Phase::Composite].bytes += picture.pixels.size() * sizeof(Rgba);
  if (const auto glow = glow_at(shot, frame)) {
    picture = timed(report[Phase::Composite].seconds, [&] { return with_glow(picture, *glow); });
  }
  write_picture(shot, frame, setup, picture, report);
  if (shot.output.review) make_review(shot, colours, frame, setup, picture, looks, report);
}

std::vector<Amplification> kept_amplifications(const Shot& shot, int frame) {
  return amplifications_from_text(
      read_exr_attribute(picture_path(shot, frame), "amplification").value_or(""));
}

}  // namespace lensplane
