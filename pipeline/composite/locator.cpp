// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/locator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace lensplane {
namespace {

// Radius of the nearest marker, as a share of the frame's width.
constexpr double kMarkerSize = 0.05;
constexpr double kClearest = 0.15;  // alpha in the middle of a marker

// Linear, working space; neighbours well apart, also for colour-blind eyes.
constexpr std::array<Rgba, 6> kMarkerColours = {{{.90F, .35F, .02F, 1},
                                                 {.05F, .45F, .75F, 1},
                                                 {.85F, .75F, .10F, 1},
                                                 {.05F, .50F, .25F, 1},
                                                 {.60F, .20F, .45F, 1},
                                                 {.60F, .60F, .60F, 1}}};

/// A bubble: nearly clear in the middle, dense towards the limb, so that of markers behind one another all
/// are seen. The side that faces the camera is the middle of the texture.
std::shared_ptr<const Texture> marker_texture(std::size_t lens) {
  constexpr int kWidth = 128, kHeight = 64;
  Picture picture{kWidth, kHeight, 0, 0, kWidth, kHeight, {}};
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const Vec3 normal = sphere_normal_from_st({(column + 0.5) / kWidth, 1 - (row + 0.5) / kHeight});
      const double from_middle2 = 1 - normal.z * normal.z;  // 0 in the middle of the disc, 1 at its limb
      const auto alpha = static_cast<float>(kClearest + (1 - kClearest) * from_middle2 * from_middle2);
      Rgba colour = kMarkerColours[lens % kMarkerColours.size()];
      for (float& channel : colour) channel *= alpha;
      picture.pixels.push_back(colour);
    }
  }
  return std::make_shared<const Texture>(std::move(picture), Wrap::Globe);
}

double depth_of(const Camera& camera, const Vec3& point) {
  return -camera.axes.local_from_parent(point - camera.position).z;
}

}  // namespace

LocatorView make_locator(const Scene& scene, const std::vector<SurfaceLook>& looks) {
  const Camera& camera = scene.camera;
  LocatorView locator{{camera, {}, scene.surfaces}, looks};
  double nearest = std::numeric_limits<double>::infinity();
  for (const Lens& lens : scene.lenses) {
    const double depth = depth_of(camera, lens.position);
    if (depth > 0) nearest = std::min(nearest, depth);
  }
  const double radius = kMarkerSize * nearest * 2.0 * std::tan(camera.fov_rad / 2.0);
  for (std::size_t i = 0; i < scene.lenses.size(); ++i) {
    if (!(depth_of(camera, scene.lenses[i].position) > 0)) continue;
    locator.scene.surfaces.push_back(Sphere{scene.lenses[i].position, radius, camera.axes});
    // Lit from the camera's upper right, so that the markers read as round.
    locator.looks.push_back({marker_texture(i), Vec3(0.4, 0.5, 0.77).normalized()});
  }
  return locator;
}

}  // namespace lensplane
