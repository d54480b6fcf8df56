// SPDX-License-Identifier: Apache-2.0

#include "pipeline/sequence/render_frame.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "pipeline/composite/compositor.h"
#include "pipeline/composite/locator.h"
#include "pipeline/image/png_writer.h"
#include "pipeline/sequence/make_maps.h"
#include "pipeline/sequence/output_paths.h"
#include "pipeline/shot/shot_scene.h"

namespace lensplane {
namespace {

ExrWindow window_of(const Camera& camera) {
  return {camera.width, camera.height, camera.overscan};
}

/// "earth 4.46 moon -": as the picture's header keeps the factors.
std::string text_from_amplifications(const std::vector<Amplification>& amplifications) {
  std::string text;
  for (const Amplification& a : amplifications) {
    text += fmt::format("{}{} {}", text.empty() ? "" : " ", a.layer,
                        a.factor ? fmt::format("{}", *a.factor) : "-");
  }
  return text;
}

std::vector<Amplification> amplifications_from_text(const std::string& text) {
  std::vector<Amplification> amplifications;
  std::istringstream words(text);
  for (std::string layer, factor; words >> layer >> factor;) {
    double value = 0;
    const auto parsed = std::from_chars(factor.data(), factor.data() + factor.size(), value);
    const bool known = parsed.ec == std::errc();
    amplifications.push_back({layer, known ? std::optional(value) : std::nullopt});
  }
  return amplifications;
}

std::vector<SurfaceLook> load_looks(const Shot& shot, const Scene& scene, TextureStore& textures, int frame,
                                    FrameReport& report) {
  std::vector<SurfaceLook> looks;
  const std::vector<LayerSurface> surfaces = surfaces_of(shot);
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const std::size_t layer = surfaces[k].layer;
    SurfaceLook look;
    look.texture = timed(report[Phase::Load].seconds, [&] { return textures.texture(layer, frame); });
    report[Phase::Load].bytes += look.texture->picture().pixels.size() * sizeof(Rgba);
    if (const auto light = light_at(shot.layers[layer], frame)) {
      look.light = std::get<Sphere>(scene.surfaces[k]).axes.local_from_parent(*light);
    }
    looks.push_back(std::move(look));
  }
  return looks;
}

std::vector<Amplification> amplifications_of(const Shot& shot, const Scene& scene, Method method,
                                             const std::vector<std::int64_t>& hits) {
  Scene without_lenses{scene.camera, {}, {}};
  std::vector<std::size_t> spheres;
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    if (!std::holds_alternative<Sphere>(scene.surfaces[k])) continue;
    without_lenses.surfaces.push_back(scene.surfaces[k]);
    spheres.push_back(k);
  }
  if (spheres.empty()) return {};
  const auto unlensed = count_hits(Tracer(without_lenses, plan_trace(without_lenses, method)));
  std::vector<Amplification> amplifications;
  const std::vector<LayerSurface> surfaces = surfaces_of(shot);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    Amplification a{shot.layers[surfaces[spheres[i]].layer].name, std::nullopt};
    if (unlensed[i] > 0) a.factor = static_cast<double>(hits[spheres[i]]) / static_cast<double>(unlensed[i]);
    amplifications.push_back(std::move(a));
  }
  return amplifications;
}

void write_picture(const Shot& shot, int frame, const FrameSetup& setup, const Picture& picture,
                   FrameReport& report) {
  ExrHeader header = setup.picture_header;
  header.amplification = text_from_amplifications(report.amplifications);
  std::vector<ExrChannel> channels;
  for (const char* name : {"R", "G", "B", "A"}) {
    channels.push_back({name, picture.pixels.front().data() + channels.size(), 4});
  }
  report[Phase::Write].bytes += timed(report[Phase::Write].seconds, [&] {
    return write_exr(picture_path(shot, frame), window_of(setup.scene.camera), channels, shot.output.image,
                     header);
  });
}

/// The display window of a picture, without its overscan.
Picture display_window(const Picture& picture) {
  Picture window{picture.display_width, picture.display_height, 0, 0,
                 picture.display_width, picture.display_height, {}};
  for (int row = 0; row < window.height; ++row) {
    const Rgba* first = &picture.at(-picture.x, row - picture.y);
    window.pixels.insert(window.pixels.end(), first, first + window.width);
  }
  return window;
}

Picture beside(const Picture& left, const Picture& right) {
  Picture both{left.width + right.width, left.height, 0, 0, left.width + right.width, left.height, {}};
  for (int row = 0; row < both.height; ++row) {
    for (const Picture* part : {&left, &right}) {
      both.pixels.insert(both.pixels.end(), &part->at(0, row), &part->at(0, row) + part->width);
    }
  }
  return both;
}

void make_review(const Shot& shot, const ColourConfig& colours, int frame, const FrameSetup& setup,
                 const Picture& picture, const std::vector<SurfaceLook>& looks, FrameReport& report) {
  Picture shown = display_window(picture);
  if (shot.output.locator == Locator::Beside) {
    const LocatorView locator = make_locator(setup.scene, looks);
    const Tracer tracer(locator.scene, plan_trace(locator.scene, setup.plan.method));
    const Composite view =
        timed(report[Phase::Composite].seconds, [&] { return composite(tracer, locator.looks); });
    shown = beside(shown, display_window(view.picture));
  }
  const Picture display = timed(report[Phase::View].seconds, [&] {
    return colours.to_display(shown, shot.colour.working.text, shot.colour.display.text,
                              shot.colour.view.text);
  });
  report[Phase::View].bytes += display.pixels.size() * sizeof(Rgba);
  report[Phase::Write].bytes += timed(report[Phase::Write].seconds, [&] {
    return write_png(review_path(shot, frame), display,
                     {setup.review_parameters, colours.is_srgb(shot.colour.display.text)});
  });
}

void make_picture(const Shot& shot, const ColourConfig& colours, TextureStore& textures, int frame,
                  const FrameSetup& setup, FrameReport& report) {
  const auto looks = load_looks(shot, setup.scene, textures, frame, report);
  const Tracer tracer(setup.scene, setup.plan);
  const Composite result = timed(report[Phase::Composite].seconds, [&] { return composite(tracer, looks); });
  report.rays += static_cast<std::int64_t>(result.picture.pixels.size()) * kRaysPerPixel;
  report[Phase::Composite].bytes += result.picture.pixels.size() * sizeof(Rgba);
  report.amplifications = timed(report[Phase::Trace].seconds, [&] {
    return amplifications_of(shot, setup.scene, setup.plan.method, result.hits);
  });
  write_picture(shot, frame, setup, result.picture, report);
  if (shot.output.review) make_review(shot, colours, frame, setup, result.picture, looks, report);
}

}  // namespace

FrameReport render_frame(const Shot& shot, const ColourConfig& colours, TextureStore& textures, int frame,
                         const FrameTasks& tasks) {
  FrameReport report;
  report.frame = frame;
  timed(report.seconds, [&] {
    const FrameSetup setup = set_up_frame(shot, colours, textures, frame, tasks);
    const bool maps_done = setup.maps.empty() && setup.data.empty();
    report.already_done = maps_done && !setup.picture;
    if (!maps_done) make_maps(shot, frame, setup, report);
    if (setup.picture) make_picture(shot, colours, textures, frame, setup, report);
    if (tasks.picture && !setup.picture) {
      const auto kept = read_exr_attribute(picture_path(shot, frame), "amplification");
      report.amplifications = amplifications_from_text(kept.value_or(""));
    }
  });
  return report;
}

}  // namespace lensplane
