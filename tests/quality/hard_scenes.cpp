// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/hard_scenes.h"

#include <array>
#include <cmath>

#include "src/constants.h"
#include "src/projection.h"
#include "tests/quality/drawn_pictures.h"

namespace lensplane {
namespace {

constexpr int kWidth = 256, kHeight = 144;
constexpr int kFinely = 4;  // texels to a pixel
constexpr double kFar = 1e9;

Camera camera_of(double fov_deg) {
  Camera camera;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.fov_rad = fov_deg * kPi / 180;
  return camera;
}

/// (x, y) pixels right of and above the middle of the frame, at a depth.
Vec3 place(const Camera& camera, double x, double y, double depth) {
  const double slope = slope_per_pixel(camera);
  return {x * slope * depth, y * slope * depth, -depth};
}

/// A mass there whose Einstein ring has a radius of `ring` pixels for what lies `behind` times as far away.
Lens mass_at(const Camera& camera, double x, double y, double depth, double ring, double behind) {
  const double angle = ring * slope_per_pixel(camera);
  return {0.25 * depth * angle * angle / (1 - 1 / behind), place(camera, x, y, depth)};
}

constexpr double kInfinitely = 1e300;

/// Adds a surface and its picture.
void add(HardScene& hard, const Surface& surface, Picture picture, Wrap edge) {
  hard.scene.surfaces.push_back(surface);
  hard.surfaces.push_back(seen(std::move(picture), edge));
}

HardScene line_art_behind_seven_masses() {
  HardScene hard{"line art behind seven masses", {camera_of(3), {}, {}}, {}};
  const Camera& camera = hard.scene.camera;
  constexpr std::array<std::array<double, 3>, 7> kMasses = {
      {{-90, 30, 16}, {-50, -35, 9}, {-20, 20, 20}, {10, -20, 6}, {45, 35, 12}, {60, -25, 24}, {105, 10, 8}}};
  double depth = kFar;
  for (const auto& [x, y, ring] : kMasses) {
    hard.scene.lenses.push_back(mass_at(camera, x, y, depth, ring, kInfinitely));
    depth *= 1.1;
  }
  add(hard, Plate{}, line_art(kFinely * kWidth, kFinely * kHeight, kWidth), Wrap::Mirror);
  return hard;
}

/// A globe whose pole leans `lean` degrees aside from the camera.
Sphere globe(const Vec3& centre, double radius, double lean) {
  const double angle = lean * kPi / 180;
  const Vec3 pole(std::sin(angle), 0, std::cos(angle)), aside(0, 1, 0);
  return {centre, radius, {aside, pole, aside.cross(pole)}};
}

HardScene pole_behind_a_lens() {
  HardScene hard{"a pole behind a lens", {camera_of(3), {}, {}}, {}};
  const Camera& camera = hard.scene.camera;
  const double pixel = slope_per_pixel(camera) * 2 * kFar;
  hard.scene.lenses = {mass_at(camera, 14, 8, kFar, 22, 2)};
  add(hard, globe(place(camera, 0, 0, 2 * kFar), 55 * pixel, 8), graticule(2048, 1024), Wrap::Globe);
  return hard;
}

HardScene two_close_planes() {
  HardScene hard{"two close lens planes", {camera_of(3), {}, {}}, {}};
  const Camera& camera = hard.scene.camera;
  hard.scene.lenses = {mass_at(camera, -14, 4, kFar, 26, kInfinitely),
                       mass_at(camera, 13, -6, 1.001 * kFar, 22, kInfinitely)};
  add(hard, Plate{}, line_art(kFinely * kWidth, kFinely * kHeight, kWidth), Wrap::Mirror);
  return hard;
}

HardScene card_before_a_sphere() {
  HardScene hard{"a card before a sphere", {camera_of(3), {}, {}}, {}};
  const Camera& camera = hard.scene.camera;
  const double pixel = slope_per_pixel(camera) * 4 * kFar;
  hard.scene.lenses = {mass_at(camera, -30, 12, kFar, 14, 4),
                       mass_at(camera, 34, -10, 3 * kFar, 16, 4.0 / 3)};
  add(hard, globe(place(camera, 6, 0, 4 * kFar), 52 * pixel, 70), graticule(2048, 1024), Wrap::Globe);
  add(hard, Card{2 * kFar}, line_art(kFinely * kWidth, kFinely * kHeight, kWidth, false), Wrap::Black);
  return hard;
}

HardScene hole_before_bright_stars() {
  HardScene hard{"a hole at 20 r_g before HDR stars", {camera_of(80), {}, {}}, {}};
  hard.scene.lenses = {{1, {1, 0.5, -std::sqrt(400 - 1.25)}}};
  add(hard, LatLong{}, bright_stars(4096, 2048), Wrap::Globe);
  return hard;
}

HardScene wide_fisheye() {
  HardScene hard{"a 200 deg fisheye", {camera_of(200), {}, {}}, {}};
  hard.scene.camera.width = hard.scene.camera.height = 176;
  hard.scene.camera.projection = Projection::Fisheye;
  hard.scene.lenses = {{0.4, {5, 3, -12}}, {0.3, {-9, 1, 2}}};
  add(hard, LatLong{}, graticule(2048, 1024), Wrap::Globe);
  add(hard, globe({0, -6, -9}, 3, 30), graticule(1024, 512), Wrap::Globe);
  return hard;
}

}  // namespace

std::vector<HardScene> hard_scenes() {
  std::vector<HardScene> scenes;
  scenes.push_back(line_art_behind_seven_masses());
  scenes.push_back(pole_behind_a_lens());
  scenes.push_back(two_close_planes());
  scenes.push_back(card_before_a_sphere());
  scenes.push_back(hole_before_bright_stars());
  scenes.push_back(wide_fisheye());
  return scenes;
}

}  // namespace lensplane
