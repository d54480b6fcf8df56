// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>

#include "tests/quality/quality_scenes.h"
#include "tests/quality/reports.h"
#include "tests/quality/scores.h"
#include "tests/quality/ways.h"

namespace lensplane {
namespace {

constexpr int kRays = 12;  // per pixel and axis of the truth: frames are large

using Pictures = std::vector<const Picture*>;

/// The best of the pictures by the truth that favours it.
double best(const Pictures& pictures, const Truth& truth, const std::vector<bool>& counts) {
  double best = 0;
  for (const Picture* picture : pictures) {
    for (const Picture* right : {&truth.by_pixel_filter, &truth.by_box})
      best = std::max(best, psnr(squares(*picture, *right), 1, counts));
  }
  return best;
}

void report_stills(const std::string& name, const Picture& plate) {
  const Frame frame = make_frame(scene_behind_three_masses(), {seen(plate, Wrap::Black)}, kRays);
  const std::vector<bool> arcs = magnified(frame.maps[0], 2);
  const Picture& truth = frame.truth.by_pixel_filter;
  const Pictures oiio = {&frame.st_warp[0], &frame.st_warp[1]};
  const auto row = [&](const std::vector<bool>& counts) {
    return fmt::format("{:.1f} | {:.1f} | {:.1f} | {:.1f}", psnr(squares(frame.render, truth), 1, counts),
                       best(oiio, frame.truth, counts), best({&frame.area}, frame.truth, counts),
                       best({&frame.supersampled}, frame.truth, counts));
  };
  fmt::print("| {} | {} | {} | {:.3f} |\n", name, row({}), row(arcs),
             sharpness(frame.render, arcs) / sharpness(truth, arcs));
}

/// The least flicker of pictures of two frames by either truth.
struct Flickers {
  std::vector<Flicker> by_filter, by_box;
  explicit Flickers(std::size_t count) : by_filter(count), by_box(count) {}

  void add(const Pictures& before, const Pictures& after, const Truth& a, const Truth& b) {
    for (std::size_t i = 0; i < by_filter.size(); ++i) {
      by_filter[i].add(*before[i], *after[i], a.by_pixel_filter, b.by_pixel_filter);
      by_box[i].add(*before[i], *after[i], a.by_box, b.by_box);
    }
  }
  double least() const {
    double least = 1e30;
    for (const auto* flickers : {&by_filter, &by_box}) {
      for (const Flicker& flicker : *flickers) least = std::min(least, flicker.rms());
    }
    return least;
  }
};

void report_flicker(const std::string& name, const Picture& plate, int frames) {
  const std::vector<Seen> surfaces = {seen(plate, Wrap::Black)};
  Flicker ours;
  Flickers oiio(2), area(1), supersampled(1);
  Frame before = make_frame(scene_behind_three_masses(0), surfaces, kRays);
  for (int i = 1; i < frames; ++i) {
    Frame after = make_frame(scene_behind_three_masses(0.1 * i), surfaces, kRays);
    const Truth &a = before.truth, &b = after.truth;
    ours.add(before.render, after.render, a.by_pixel_filter, b.by_pixel_filter);
    oiio.add({&before.st_warp[0], &before.st_warp[1]}, {&after.st_warp[0], &after.st_warp[1]}, a, b);
    area.add({&before.area}, {&after.area}, a, b);
    supersampled.add({&before.supersampled}, {&after.supersampled}, a, b);
    before = std::move(after);
  }
  fmt::print("| {} | {:.5f} | {:.5f} | {:.5f} | {:.5f} |\n", name, ours.rms(), oiio.least(), area.least(),
             supersampled.least());
}

}  // namespace

void report_plates(bool moving) {
  const std::string textures = std::string(LENSPLANE_SOURCE_DIR) + "/textures/";
  const Picture night = piece_of(textures + "earth_night.jpg", 1900, 500);
  fmt::print(
      "| plate, dB | render | st_warp | area filter | supersampling | arcs: render | arcs: st_warp | "
      "arcs: area filter | arcs: supersampling | arcs: sharpness of render |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|\n");
  report_stills("zone plate", zone_plate());
  report_stills("checker", checker());
  report_stills("night Earth", night);
  if (!moving) return;
  fmt::print("\n| moving lens over | flicker: render | st_warp | area filter | supersampling |\n");
  fmt::print("|---|---|---|---|---|\n");
  report_flicker("night Earth", night, 3);
  report_flicker("stars", piece_of(textures + "stars_sky.png", 1900, 700), 3);
}

}  // namespace lensplane
