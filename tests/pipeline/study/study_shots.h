// SPDX-License-Identifier: Apache-2.0
//
// Small shots to be studied, and how little work to put into it.

#pragma once

#include <fmt/format.h>

#include <random>
#include <string>

#include "pipeline/shot/shot_reader.h"
#include "pipeline/study/study.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {

/// Every row once, a few rays.
inline StudyEffort little_effort(int rays = 400) {
  return {rays, {0.0, 1, 1}, 2, 8};
}

inline Shot shot_from(const std::string& text) {
  const TemporaryFolder folder;
  return read_shot(folder.write("shot.yaml", text).string(), {});
}

/// A single mass of `suns` before a sky, seen from 1e9 m by a frame of 96 x 64.
inline std::string one_mass(double suns, const std::string& more = "") {
  return fmt::format(
      "lensplane: 1\nshot: one\nframes: 1001\ncamera: {{resolution: [96, 64], fov: 10 deg}}\n"
      "lenses: [{{name: hole, mass: {} Msun, position: [1e7 m, 2e7 m, -1e9 m]}}]\n"
      "layers: [{{name: sky, type: latlong, image: sky.exr}}]\n{}",
      suns, more);
}

/// A shot of any projection, with masses near and far, light and heavy, and layers of every kind.
inline std::string random_shot(std::mt19937& random) {
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  const auto spread = [&](double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); };
  const char* projection = std::array{"perspective", "perspective", "latlong", "fisheye"}[random() % 4];
  const bool flat = std::string(projection) == "perspective";
  std::string text = fmt::format(
      "lensplane: 1\nshot: random\nframes: 1001\ncamera: {{resolution: [96, 64], projection: {}{}}}\n",
      projection, std::string(projection) == "latlong" ? "" : fmt::format(", fov: {} deg", spread(0.1, 120)));
  const double distance = spread(1e6, 1e15);
  text += "lenses:\n";
  const auto count = 1 + random() % 4;
  for (unsigned long i = 0; i < count; ++i) {
    const double z = distance * spread(0.3, 3);
    // Geometric masses up to a thousandth of the distance: 1477 m are a sun.
    text += fmt::format("  - {{name: lens{}, mass: {} Msun, position: [{} m, {} m, {} m]}}\n", i,
                        z * spread(1e-10, 1e-3) / 1477, z * uniform(-1, 1), z * uniform(-1, 1), -z);
  }
  text += "layers:\n  - {name: sky, type: latlong, image: sky.exr}\n";
  if (flat) text += "  - {name: bg, type: plate, image: bg.exr}\n";
  if (random() % 2)
    text += fmt::format(
        "  - {{name: ball, type: sphere, image: ball.exr, radius: {} m, centre: [0 m, 0 m, {} m]}}\n",
        distance * spread(0.01, 0.3), -distance * spread(1, 10));
  if (random() % 2)
    text += fmt::format(
        "  - {{name: ring, type: ring, image: ring.exr, inner: 0 m, outer: {} m, normal: [0, 1, 1], centre: "
        "[0 m, 0 m, {} m]}}\n",
        distance * spread(0.1, 1), -distance * spread(1, 10));
  if (flat && random() % 2)
    text += fmt::format("  - {{name: card, type: plate, image: card.exr, distance: {} m}}\n",
                        distance * spread(0.5, 5));
  return text + fmt::format("trace: {{tolerance: {} px}}\n", spread(1e-3, 1));
}

}  // namespace lensplane
