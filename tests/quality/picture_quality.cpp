// SPDX-License-Identifier: Apache-2.0
//
// How good pictures are: ours and OpenImageIO's st_warp against the truth, as a table.
//
// Run by hand; docs/performance.md holds its results. PSNR in decibels of linear light, the brightest pixel
// of a plate being 1. st_warp gets our map with all its digits, and may choose the better of its default
// filter and the triangle, and of the two truths the one that favours it.

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "pipeline/composite/compositor.h"
#include "src/lens_map.h"
#include "tests/quality/quality_scenes.h"
#include "tests/quality/truth.h"

namespace lensplane {
namespace {

using Differences = std::vector<double>;

/// Squares of the differences of two pictures, a number per pixel.
Differences squares(const Picture& a, const Picture& b) {
  Differences result;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double off = static_cast<double>(a.pixels[i][c]) - static_cast<double>(b.pixels[i][c]);
      sum += off * off / 3.0;
    }
    result.push_back(sum);
  }
  return result;
}

/// PSNR over the pixels that `counts`.
double psnr(const Differences& squares, const std::vector<bool>& counts) {
  double sum = 0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    if (!counts[i]) continue;
    sum += squares[i];
    ++pixels;
  }
  return -10.0 * std::log10(std::max(sum / static_cast<double>(pixels), 1e-30));
}

Tracer tracer_of(const Scene& scene) {
  TraceSettings settings;
  settings.effects.jacobian = true;
  settings.effects.magnification = true;
  return {scene, plan_trace(scene, settings)};
}

Picture warped_by_oiio(const LensMap& map, const Picture& plate, const std::string& filter) {
  const OIIO::ImageSpec spec(map.width, map.height, 4, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf source(spec, const_cast<float*>(plate.pixels.front().data()));
  OIIO::ImageBuf coordinates(OIIO::ImageSpec(map.width, map.height, 2, OIIO::TypeDesc::FLOAT));
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const std::size_t i = static_cast<std::size_t>(row * map.width + column);
      const std::array<float, 2> st{map.s[i], map.t[i]};
      coordinates.setpixel(column, row, st.data(), 2);
    }
  }
  const OIIO::ImageBuf result =
      OIIO::ImageBufAlgo::st_warp(source, coordinates, filter, 0.0F, 0, 1, false, true);
  Picture picture = plate;
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      const std::size_t i = static_cast<std::size_t>(row * map.width + column);
      result.getpixel(column, row, picture.pixels[i].data(), 4);
      for (float& channel : picture.pixels[i]) channel *= map.valid[i];
    }
  }
  return picture;
}

/// A frame by every way of making it.
struct Frame {
  Truth truth;
  Picture ours, by_default, by_triangle;
  std::vector<bool> magnified;  // by more than 2
};

Frame make_frame(const Scene& scene, const Picture& plate) {
  const Tracer tracer = tracer_of(scene);
  const auto texture = std::make_shared<const Texture>(plate, Wrap::Black);
  const LensMap map = std::move(trace_maps(tracer).front());
  Frame frame{true_picture(tracer, *texture),
              composite(tracer, {{texture}}, {}).picture,
              warped_by_oiio(map, plate, ""),
              warped_by_oiio(map, plate, "triangle"),
              {}};
  for (const float magnification : map.passes[4].values)
    frame.magnified.push_back(std::abs(magnification) > 2);
  return frame;
}

double best_of_st_warp(const Frame& frame, const std::vector<bool>& counts) {
  double best = 0;
  for (const Picture* picture : {&frame.by_default, &frame.by_triangle}) {
    for (const Picture* truth : {&frame.truth.by_pixel_filter, &frame.truth.by_box}) {
      best = std::max(best, psnr(squares(*picture, *truth), counts));
    }
  }
  return best;
}

/// How much detail a picture has: the mean square of the differences of neighbours.
double sharpness(const Picture& picture, const std::vector<bool>& counts) {
  double sum = 0;
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 1; column < picture.width; ++column) {
      if (!counts[static_cast<std::size_t>(row * picture.width + column)]) continue;
      const float off = picture.at(column, row)[1] - picture.at(column - 1, row)[1];
      sum += static_cast<double>(off) * static_cast<double>(off);
    }
  }
  return sum;
}

void report_stills(const std::string& name, const Picture& plate) {
  const Frame frame = make_frame(scene_behind_three_masses(), plate);
  const std::vector<bool> all(plate.pixels.size(), true);
  const Differences ours = squares(frame.ours, frame.truth.by_pixel_filter);
  fmt::print(
      "| {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.3f} |\n", name, psnr(ours, all),
      best_of_st_warp(frame, all), psnr(ours, frame.magnified), best_of_st_warp(frame, frame.magnified),
      sharpness(frame.ours, frame.magnified) / sharpness(frame.truth.by_pixel_filter, frame.magnified));
}

/// Root mean square of how a picture's change from frame to frame differs from the truth's.
class Flicker {
 public:
  void add(const Picture& before, const Picture& after, const Picture& true_before,
           const Picture& true_after) {
    for (std::size_t i = 0; i < before.pixels.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double change = after.pixels[i][c] - before.pixels[i][c];
        const double true_change = true_after.pixels[i][c] - true_before.pixels[i][c];
        sum_ += (change - true_change) * (change - true_change);
        ++count_;
      }
    }
  }
  double rms() const { return std::sqrt(sum_ / static_cast<double>(count_)); }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

void report_flicker(const std::string& name, const Picture& plate, int frames) {
  Flicker ours, by_default, by_triangle, by_default_box, by_triangle_box;
  Frame before = make_frame(scene_behind_three_masses(0), plate);
  for (int i = 1; i < frames; ++i) {
    Frame after = make_frame(scene_behind_three_masses(0.1 * i), plate);
    const Truth &a = before.truth, &b = after.truth;
    ours.add(before.ours, after.ours, a.by_pixel_filter, b.by_pixel_filter);
    by_default.add(before.by_default, after.by_default, a.by_pixel_filter, b.by_pixel_filter);
    by_triangle.add(before.by_triangle, after.by_triangle, a.by_pixel_filter, b.by_pixel_filter);
    by_default_box.add(before.by_default, after.by_default, a.by_box, b.by_box);
    by_triangle_box.add(before.by_triangle, after.by_triangle, a.by_box, b.by_box);
    before = std::move(after);
  }
  const double warp =
      std::min({by_default.rms(), by_triangle.rms(), by_default_box.rms(), by_triangle_box.rms()});
  fmt::print("| {} | {:.5f} | {:.5f} | {:.2f} |\n", name, ours.rms(), warp, ours.rms() / warp);
}

}  // namespace
}  // namespace lensplane

int main(int count, char** arguments) {
  using namespace lensplane;
  const std::string textures = std::string(LENSPLANE_SOURCE_DIR) + "/textures/";
  const bool moving = count < 2 || std::string(arguments[1]) != "stills";
  const Picture night = piece_of(textures + "earth_night.jpg", 1900, 500);
  fmt::print("| plate | ours, dB | st_warp, dB | arcs: ours | arcs: st_warp | arcs: sharpness of ours |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  report_stills("zone plate", zone_plate());
  report_stills("checker", checker());
  report_stills("night Earth", night);
  if (!moving) return 0;
  fmt::print("\n| moving lens over | flicker, ours | st_warp | ratio |\n|---|---|---|---|\n");
  report_flicker("night Earth", night, 5);
  report_flicker("stars", piece_of(textures + "stars_sky.png", 1900, 700), 5);
}
