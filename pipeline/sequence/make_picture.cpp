// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/make_picture.h"

#include "pipeline/composite/compositor.h"
#include "pipeline/composite/glow.h"
#include "pipeline/composite/star_layer.h"
#include "pipeline/sequence/fingerprint.h"
#include "pipeline/sequence/frame_looks.h"
#include "pipeline/sequence/make_review.h"
#include "pipeline/sequence/maps_picture.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/sequence/shot_glow.h"
#include "pipeline/sequence/shutter.h"
#include "pipeline/sequence/side_by_side.h"
#include "pipeline/shot/shot_scene.h"
#include "src/map_channels.h"

namespace lensplane {
namespace {

std::vector<SurfaceLook> load_looks(const Shot& shot, const Scene& scene, ShotAssets& assets, int frame,
                                    double time, FrameReport& report) {
  return timed(report[Phase::Load].seconds,
               [&] { return looks_at(shot, scene, assets.textures, frame, time); });
}

/// What the images of the frame hold, what of it is no number, and which are missing.
void report_images(const Shot& shot, const TextureStore& textures, int frame,
                   const std::vector<SurfaceLook>& looks, FrameReport& report) {
  const std::vector<LayerSurface> surfaces = surfaces_of(shot);
  for (std::size_t k = 0; k < looks.size(); ++k) {
    if (surfaces[k].crossing > 0) continue;
    std::int64_t not_numbers = 0;
    for (const auto& texture : {looks[k].texture, looks[k].night}) {
      if (!texture) continue;
      report[Phase::Load].bytes += texture->bytes();
      not_numbers += texture->not_numbers();
    }
    if (const auto stand_in = textures.stand_in(surfaces[k].layer, frame))
      report.missing.push_back({shot.layers[surfaces[k].layer].name, stand_in->frame});
    if (not_numbers > 0) report.replaced.push_back({shot.layers[surfaces[k].layer].name, not_numbers});
  }
}

/// The picture of one instant. `empty` is known of the rays that `setup` describes.
Composite take_instant(const Shot& shot, ShotAssets& assets, int frame, const Moment& moment,
                       const FrameSetup& setup, const EmptySpace& empty, FrameReport& report) {
  const Scene scene = scene_at(shot, moment.time);
  const auto looks = load_looks(shot, scene, assets, frame, moment.time, report);
  TraceSettings settings = trace_at(shot, moment.time);
  settings.effects = {};
  settings.effects.jacobian = true;
  return timed(report[Phase::Composite].seconds, [&] {
    const Tracer tracer(scene, plan_trace(scene, settings));
    const bool same = fingerprint_of_trace(scene, tracer.plan()).digest() ==
                      fingerprint_of_trace(setup.scene, setup.plan).digest();
    Composite instant = composite(tracer, looks, moment.sampling, same ? empty : EmptySpace());
    for (std::size_t k = 0; k < shot.layers.size(); ++k) {
      if (!std::holds_alternative<StarsLayer>(shot.layers[k].kind)) continue;
      add_stars(tracer, looks, *assets.stars.field(k, moment.time), instant.picture);
    }
    report.rays += instant.rays;
    report.unresolved += instant.unresolved;
    return instant;
  });
}

/// The mean of the instants while the shutter is open.
Composite take_exposure(const Shot& shot, ShotAssets& assets, int frame, const FrameSetup& setup,
                        const EmptySpace& empty, FrameReport& report) {
  const std::vector<Moment> moments = moments_of(shot, frame);
  Composite exposure = take_instant(shot, assets, frame, moments.front(), setup, empty, report);
  for (std::size_t n = 1; n < moments.size(); ++n) {
    add(take_instant(shot, assets, frame, moments[n], setup, empty, report), exposure);
  }
  scale(1.0 / static_cast<double>(moments.size()), exposure);
  return exposure;
}

void write_picture(const Shot& shot, int frame, const FrameSetup& setup, const ShadowedPicture& result,
                   FrameReport& report) {
  const Picture& picture = result.picture;
  ExrHeader header = setup.picture_header;
  header.amplification = text_from_amplifications(report.amplifications);
  const Camera& camera = setup.scene.camera;
  std::vector<ExrChannel> channels;
  for (const char* name : {"R", "G", "B", "A"}) {
    channels.push_back({name, picture.pixels.front().data() + channels.size(), 4});
  }
  if (!shot.lenses.empty()) channels.push_back({std::string(kShadowChannel), result.shadow.data()});
  report[Phase::Write].bytes += timed(report[Phase::Write].seconds, [&] {
    return write_exr(picture_path(shot, frame), {camera.width, camera.height, camera.overscan}, channels,
                     shot.output.image, header);
  });
}

}  // namespace

std::vector<SurfaceLook> load_picture(const Shot& shot, ShotAssets& assets, int frame,
                                      const FrameSetup& setup, FrameReport& report) {
  // Stars first: they do not wait for the library that reads images.
  timed(report[Phase::Load].seconds, [&] {
    for (std::size_t k = 0; k < shot.layers.size(); ++k) {
      if (std::holds_alternative<StarsLayer>(shot.layers[k].kind)) assets.stars.field(k, frame);
    }
  });
  return load_looks(shot, setup.scene, assets, frame, frame, report);
}

void make_picture(const Shot& shot, const ColourConfig& colours, ShotAssets& assets, int frame,
                  const FrameTasks& tasks, const FrameSetup& setup, const std::vector<SurfaceLook>& looks,
                  const EmptySpace& empty, FrameReport& report) {
  ShadowedPicture result;
  Picture& picture = result.picture;
  if (tasks.from_maps) {
    result = picture_from_maps(shot, assets, frame, setup, looks, report);
  } else {
    Composite exposure = take_exposure(shot, assets, frame, setup, empty, report);
    report.amplifications =
        timed(report[Phase::Trace].seconds, [&] { return amplifications_of(shot, frame, exposure.hits); });
    result = {std::move(exposure.picture), std::move(exposure.shadow)};
  }
  if (shot.trace.shadow == HoleShadow::Opaque) blacken_shadow(result);
  expose(value_at(shot.camera.exposure, frame), picture);
  report_images(shot, assets.textures, frame, looks, report);
  report[Phase::Composite].bytes += picture.pixels.size() * sizeof(Rgba);
  if (const auto glow = glow_at(shot, frame)) {
    picture = timed(report[Phase::Composite].seconds, [&] { return with_glow(picture, *glow); });
  }
  FrameReport of_review;
  side_by_side([&] { write_picture(shot, frame, setup, result, report); },
               [&] {
                 if (shot.output.review) make_review(shot, colours, frame, setup, picture, looks, of_review);
               });
  add_costs(of_review, report);
}

std::vector<Amplification> kept_amplifications(const Shot& shot, int frame) {
  return amplifications_from_text(
      read_exr_attribute(picture_path(shot, frame), "amplification").value_or(""));
}

}  // namespace lensplane
