// SPDX-License-Identifier: Apache-2.0

#include "tests/quality/quality_scenes.h"

#include <OpenImageIO/imagebuf.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/constants.h"
#include "src/projection.h"

namespace lensplane {
namespace {

Picture blank() {
  Picture picture{kFrameWidth, kFrameHeight, 0, 0, kFrameWidth, kFrameHeight, {}};
  picture.pixels.assign(std::size_t{kFrameWidth} * kFrameHeight, {});
  return picture;
}

float linear_from_srgb(float v) {
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

}  // namespace

Scene scene_behind_three_masses(double shift) {
  Scene scene;
  scene.camera.width = kFrameWidth;
  scene.camera.height = kFrameHeight;
  scene.camera.fov_rad = 3.0 * kPi / 180.0;
  const double pixel = pixel_angle(scene.camera);
  // For a plate at infinity theta_E^2 = 4 m/D.
  const double distance = 1e9;
  const auto mass = [&](double ring) { return 0.25 * distance * ring * pixel * ring * pixel; };
  const auto place = [&](double x, double y, double depth) {
    return Vec3(x * pixel * depth, y * pixel * depth, -depth);
  };
  scene.lenses = {{mass(60), place(-120 + shift, -30, distance)},
                  {mass(45), place(130, -45, 1.1 * distance)},
                  {mass(30), place(40, 90, 1.2 * distance)}};
  scene.surfaces = {Plate{}};
  return scene;
}

Picture zone_plate() {
  Picture picture = blank();
  for (int row = 0; row < kFrameHeight; ++row) {
    for (int column = 0; column < kFrameWidth; ++column) {
      const double x = column + 0.5 - kFrameWidth / 2.0, y = row + 0.5 - kFrameHeight / 2.0;
      // The phase pi r^2/H has one period in two pixels at r = H/2.
      const double phase = std::numbers::pi * (x * x + y * y) / kFrameHeight;
      const auto v = static_cast<float>(0.5 + 0.5 * std::cos(phase));
      picture.at(column, row) = {v, v, v, 1};
    }
  }
  return picture;
}

Picture checker() {
  Picture picture = blank();
  for (int row = 0; row < kFrameHeight; ++row) {
    for (int column = 0; column < kFrameWidth; ++column) {
      const float v = (column / 12 + row / 12) % 2 == 0 ? 1.0F : 0.0F;
      picture.at(column, row) = {v, v, v, 1};
    }
  }
  return picture;
}

Picture piece_of(const std::string& file, int left, int top) {
  const OIIO::ImageBuf image(file);
  Picture picture = blank();
  float brightest = 0;
  for (int row = 0; row < kFrameHeight; ++row) {
    for (int column = 0; column < kFrameWidth; ++column) {
      Rgba& pixel = picture.at(column, row);
      image.getpixel(left + column, top + row, pixel.data(), 3);
      for (std::size_t c = 0; c < 3; ++c) {
        pixel[c] = linear_from_srgb(pixel[c]);
        brightest = std::max(brightest, pixel[c]);
      }
      pixel[3] = 1;
    }
  }
  for (Rgba& pixel : picture.pixels) {
    for (std::size_t c = 0; c < 3; ++c) pixel[c] /= brightest;
  }
  return picture;
}

}  // namespace lensplane
