// SPDX-License-Identifier: Apache-2.0
//
// From a shot to the scene of one of its frames, and to what its trace has to keep to.

#pragma once

#include "pipeline/shot/shot.h"
#include "src/plan.h"

namespace lensplane {

/// A surface of a shot's scenes: which layer it shows, and where light crosses that layer more than once,
/// which of these crossings.
struct LayerSurface {
  std::size_t layer;
  int crossing = 0;
};

/// So many crossings of a ring, or of a plate at a distance, are seen in a shot with lenses.
inline constexpr int kRingCrossings = 3;
inline constexpr int kCardCrossings = 2;

/// The surfaces of the shot's scenes, the same for all frames: the first crossing of every layer, in the
/// shot's order, then the others. Stars have none.
std::vector<LayerSurface> surfaces_of(const Shot& shot);

/// For every layer which of these surfaces its map shows: the first crossing. Nothing for stars.
std::vector<std::optional<std::size_t>> map_surfaces_of(const Shot& shot);

/// Whether the shot shows stars.
bool has_stars(const Shot& shot);

/// The scene at a frame (fractions allowed), with the surfaces of surfaces_of(). Throws Failure (BadShot)
/// when the camera looks nowhere: at its own position, or straight along `up`. Overscan that is left open is
/// 0.
Scene scene_at(const Shot& shot, double frame);

/// What the shot asks of the trace at a frame, with the effects that its data files call for.
TraceSettings trace_at(const Shot& shot, double frame);

/// A sphere's direction towards the light in the world; nothing for other layers and spheres without.
std::optional<Vec3> light_at(const Layer& layer, double frame);

/// The angular radius of a sphere's light, radians; 0 for a point, for other layers and spheres without.
double sun_at(const Layer& layer, double frame);

/// The shadow on a ring: its points from which the light is behind the sphere.
struct RingShadow {
  Sphere sphere;   // in the world
  Vec3 light;      // unit vector towards the light, in the world
  double sun = 0;  // angular radius of the light, radians
};

/// The shadow that falls on a layer (an index into Shot::layers) at a frame; nothing where none does.
std::optional<RingShadow> shadow_at(const Shot& shot, std::size_t layer, double frame);

/// The same shot at 1/`divisor` of the resolution, for a quick look.
Shot proxy_of(Shot shot, int divisor);

}  // namespace lensplane
