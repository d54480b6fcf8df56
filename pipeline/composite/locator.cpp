// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/locator.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "src/projection.h"

namespace lensplane {
namespace {

// Radius of the nearest marker, as a share of the frame's width.
constexpr double kMarkerSize = 0.05;
constexpr double kLargestMarker = 0.5;  // the same as a share of its distance: the camera stays outside
constexpr double kClearest = 0.15;      // alpha in the middle of a marker

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

/// How far a lens is, as its size in the picture goes; 0 or less where the camera does not see it.
double distance_to(const Camera& camera, const Vec3& point) {
  const Vec3 seen = camera.axes.local_from_parent(point - camera.position);
  return camera.projection == Projection::Perspective ? -seen.z : seen.length();
}

/// The axes of a marker at `position`, whose +z is turned to the camera.
Basis facing(const Camera& camera, const Vec3& position) {
  if (camera.projection == Projection::Perspective) return camera.axes;
  const Basis axes = basis_looking_along(position - camera.position, camera.axes.y);
  return is_valid(axes) ? axes : basis_looking_along(position - camera.position, camera.axes.z);
}

}  // namespace

LocatorView make_locator(const Scene& scene, const std::vector<SurfaceLook>& looks) {
  const Camera& camera = scene.camera;
  LocatorView locator{{camera, {}, scene.surfaces}, looks};
  double nearest = std::numeric_limits<double>::infinity();
  for (const Lens& lens : scene.lenses) {
    const double distance = distance_to(camera, lens.position);
    if (distance > 0) nearest = std::min(nearest, distance);
  }
  const double share = std::min(kMarkerSize * pixel_angle(camera) * camera.width, kLargestMarker);
  for (std::size_t i = 0; i < scene.lenses.size(); ++i) {
    const Vec3& position = scene.lenses[i].position;
    if (!(distance_to(camera, position) > 0)) continue;
    locator.scene.surfaces.push_back(Sphere{position, share * nearest, facing(camera, position)});
    // Lit from the camera's upper right, so that the markers read as round.
    locator.looks.push_back({marker_texture(i), Vec3(0.4, 0.5, 0.77).normalized()});
  }
  return locator;
}

}  // namespace lensplane
