// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "pipeline/composite/compositor.h"
#include "src/constants.h"
#include "src/projection.h"
#include "tests/quality/drawn_pictures.h"
#include "tests/quality/reports.h"
#include "tests/quality/scores.h"
#include "tests/quality/ways.h"

namespace lensplane {
namespace {

constexpr double kDepth = 1000;
constexpr double kRing = 10;   // outer radius of rings, pixels
constexpr int kFineRays = 32;  // per pixel and axis of the truth of the photon ring

/// Smallest and largest of some numbers.
struct Range {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  std::string text() const { return fmt::format("{:.3f} to {:.3f}", least, most); }
};

Scene empty_scene(int width, int height, double fov_deg) {
  Scene scene;
  scene.camera.width = width;
  scene.camera.height = height;
  scene.camera.fov_rad = fov_deg * kPi / 180;
  return scene;
}

const std::vector<Seen>& white() {
  static const std::vector<Seen> surfaces = {seen(plain_picture(8, 4, {1, 1, 1, 1}), Wrap::Clamp)};
  return surfaces;
}

/// Metres that a pixel is wide at kDepth.
double pixel_at_depth(const Scene& scene) {
  return slope_per_pixel(scene.camera) * kDepth;
}

/// A white thing of whatever size; `at`: metres right and up of where it would stand.
using Thing = Surface (*)(const Scene& scene, double size, const Vec3& at);

Surface sphere(const Scene& scene, double size, const Vec3& at) {
  return Sphere{at + Vec3(0, 0, -kDepth), size * pixel_at_depth(scene), {}};
}

/// Face on, `size` wide.
Surface ring(const Scene& scene, double size, const Vec3& at) {
  const double pixel = pixel_at_depth(scene);
  return Ring{
      at + Vec3(0, 0, -kDepth), {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, (kRing - size) * pixel, kRing * pixel};
}

/// The sum of the alphas over what it has to be, for a thing that moves by parts of a pixel: over its `area`
/// in pixels, or over the truth's when there is none. (The pixel filter itself, which is looked at once a
/// pixel, lets the sum of a point waver by 7 %, of a disc of 0.45 px by 2 %.)
void report_moving(const std::string& name, Thing thing, double size, std::optional<double> area) {
  Range render, comp;
  for (int step = 0; step < 8; ++step) {
    Scene scene = empty_scene(40, 40, 4);
    const double pixel = pixel_at_depth(scene);
    const Vec3 at(pixel * (0.14 * step + 0.01), pixel * (0.19 * step + 0.02), 0);
    scene.surfaces = {thing(scene, size, at)};
    if (!area) {
      const double angle = 9 * slope_per_pixel(scene.camera);
      scene.lenses = {{0.25 * (kDepth / 2) * angle * angle * 2, {pixel * 2.25, -pixel * 1.1, -kDepth / 2}}};
    }
    const Tracer tracer = tracer_of(scene);
    const double right = area ? *area : total(true_picture(tracer, looks_of(white())).by_pixel_filter, 3);
    render.add(total(composite(tracer, looks_of(white()), {}).picture, 3) / right);
    comp.add(total(by_comp(tracer, maps_of(tracer), white()), 3) / right);
  }
  fmt::print("| {} | {} | {} |\n", name, render.text(), comp.text());
  std::fflush(stdout);
}

void report_thin_things() {
  fmt::print("| light over all that there is, least to most as it moves | render | comp |\n|---|---|---|\n");
  for (const double radius : {0.05, 0.1, 0.2, 0.45})
    report_moving(fmt::format("sphere, radius {} px", radius), sphere, radius, kPi * radius * radius);
  for (const double width : {0.05, 0.1, 0.3})
    report_moving(fmt::format("ring, {} px wide", width), ring, width,
                  kPi * (kRing * kRing - (kRing - width) * (kRing - width)));
  report_moving("sphere, radius 0.3 px, as an Einstein ring", sphere, 0.3, std::nullopt);
  report_moving("ring, 0.1 px wide, behind a lens", ring, 0.1, std::nullopt);
}

Picture noise(int width, int height) {
  Picture picture = plain_picture(width, height, {0, 0, 0, 1});
  std::mt19937 random(3);
  for (Rgba& pixel : picture.pixels) {
    for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<float>(random() % 1024) / 1023;
  }
  return picture;
}

/// A plate of the frame's size that nothing bends, by every edge.
void report_unlensed_plate() {
  fmt::print(
      "\n| plate that nothing bends, largest difference | render | comp | warp |\n|---|---|---|---|\n");
  Scene scene = empty_scene(96, 54, 30);
  scene.surfaces = {Plate{}};
  const Tracer tracer = tracer_of(scene);
  for (const auto& [name, edge] : {std::pair("black", Wrap::Black),
                                   {"clamp", Wrap::Clamp},
                                   {"mirror", Wrap::Mirror},
                                   {"repeat", Wrap::Repeat}}) {
    const std::vector<Seen> plate = {seen(noise(96, 54), edge)};
    const std::vector<LensMap> maps = maps_of(tracer);
    fmt::print("| noise, edge {} | {:.1e} | {:.1e} | {:.1e} |\n", name,
               largest_difference(composite(tracer, looks_of(plate), {}).picture, plate[0].picture),
               largest_difference(by_comp(tracer, maps, plate), plate[0].picture),
               largest_difference(by_warp(maps, plate), plate[0].picture));
  }
}

/// How much light is lost where the truth is white, and in the pixels of the shadow's rim together.
void report_white_sky() {
  fmt::print(
      "\n| white sky round a hole | least of white, render | with max: 1 | comp | warp | rim's light over "
      "truth's |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  Scene scene = empty_scene(160, 90, 70);
  scene.lenses = {{1, {1, 0.5, -20}}};
  scene.surfaces = {LatLong{}};
  const Tracer tracer = tracer_of(scene);
  for (const int width : {512, 4096}) {
    const std::vector<Seen> sky = {seen(plain_picture(width, width / 2, {1, 1, 1, 1}), Wrap::Globe)};
    const Picture truth = true_picture(tracer, looks_of(sky)).by_pixel_filter;
    const Picture render = composite(tracer, looks_of(sky), {}).picture;
    const std::vector<LensMap> maps = maps_of(tracer);
    const auto least = [&](const Picture& picture, bool centres) {
      float least = 1;
      for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        if (centres ? maps[0].valid[i] > 0.999F : truth.pixels[i][1] > 0.99999F)
          least = std::min(least, picture.pixels[i][1]);
      }
      return least;
    };
    double rim = 0, true_rim = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
      if (truth.pixels[i][1] < 0.0001F || truth.pixels[i][1] > 0.9999F) continue;
      rim += static_cast<double>(render.pixels[i][1]);
      true_rim += static_cast<double>(truth.pixels[i][1]);
    }
    fmt::print("| {} x {} | {:.5f} | {:.5f} | {:.5f} | {:.5f} | {:.4f} |\n", width, width / 2,
               least(render, false), least(composite(tracer, looks_of(sky), {1}).picture, true),
               least(by_comp(tracer, maps, sky), true), least(by_warp(maps, sky), true), rim / true_rim);
  }
}

/// A white plate behind one hole that moves: the light of all images, and how steady it is.
void report_photon_ring() {
  fmt::print("\n| white plate behind a hole that moves | render | comp |\n|---|---|---|\n");
  const std::vector<Seen>& plate = white();
  Range light, of_comp, worst, worst_comp;
  double steady = 0, steady_comp = 0, last = 0, last_comp = 0;
  for (int step = 0; step < 4; ++step) {
    Scene scene = empty_scene(96, 54, 40);
    const double pixel = slope_per_pixel(scene.camera) * 10;
    scene.lenses = {{0.2, {0.1 * pixel * step, 0.03 * pixel * step, -10}}};
    scene.surfaces = {Plate{}};
    const Tracer tracer = tracer_of(scene);
    const Picture truth = true_picture(tracer, looks_of(plate), kFineRays).by_pixel_filter;
    const Picture render = composite(tracer, looks_of(plate), {}).picture;
    const Picture comp = by_comp(tracer, maps_of(tracer), plate);
    const double off = total(render, 1) - total(truth, 1), off_comp = total(comp, 1) - total(truth, 1);
    light.add(off);
    of_comp.add(off_comp);
    worst.add(largest_difference(render, truth));
    worst_comp.add(largest_difference(comp, truth));
    if (step > 0) {
      steady = std::max(steady, std::abs(off - last));
      steady_comp = std::max(steady_comp, std::abs(off_comp - last_comp));
    }
    last = off;
    last_comp = off_comp;
  }
  fmt::print("| light less truth's, pixels' worth, least to most | {} | {} |\n", light.text(),
             of_comp.text());
  fmt::print("| largest change of that by 0.1 px | {:.3f} | {:.3f} |\n", steady, steady_comp);
  fmt::print("| largest difference of a pixel | {:.3f} | {:.3f} |\n", worst.most, worst_comp.most);
}

}  // namespace

void report_small_things() {
  report_thin_things();
  report_unlensed_plate();
  report_white_sky();
  report_photon_ring();
}

}  // namespace lensplane
