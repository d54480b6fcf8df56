// SPDX-License-Identifier: Apache-2.0
//
// The layers of a frame as their maps on disk have them: for pictures from maps that somebody edited.

#pragma once

#include <string>
#include <vector>

#include "pipeline/composite/map_composite.h"
#include "pipeline/shot/shot.h"
#include "src/scene.h"

namespace lensplane {

/// How far away a surface is as a whole, in metres: the distance of its centre, or infinity.
double distance_of(const Surface& surface, const Vec3& camera);

/// The layers that have maps (indices into Shot::layers), farthest first, as far as pixels do not say: skies,
/// plates, then what is nearer and nearer as a whole.
std::vector<std::size_t> depth_order(const Shot& shot, int frame);

/// Reads the maps of all layers that have one, and what their data files say of jacobian and depth. `looks`
/// in the order of the scene's surfaces. Throws Failure (BadInput) when a map is missing, broken, or has
/// other windows than the shot's camera.
std::vector<MapLayer> load_map_layers(const Shot& shot, const Scene& scene,
                                      const std::vector<SurfaceLook>& looks, int frame);

/// Which share of every pixel's light ends in masses, by its own file beside those maps; empty without lenses
/// and without `layers`. Throws Failure (BadInput) when the file is missing, broken, or has other windows.
std::vector<float> load_shadow(const Shot& shot, const std::vector<MapLayer>& layers, int frame);

/// A hash of the contents of these files. Throws Failure (BadInput) when a map is missing.
std::string digest_of_maps(const Shot& shot, int frame);

}  // namespace lensplane
