// SPDX-License-Identifier: Apache-2.0
//
// From what rays meet on a surface to the samples of its map: which channels there are, and what they hold.

#pragma once

#include "src/lens_map.h"

namespace lensplane {

inline constexpr std::string_view kShadowChannel = "lensing.shadow";

/// Makes room in `map` for so many pixels, and for the channels that `effects` call for; what it holds is not
/// kept.
void make_room(int width, int height, const Effects& effects, LensMap& map);

/// Stores what the rays number `first` to `first + count - 1` of a batch meet, from sample `at` of the map
/// on.
void store(const SurfaceBatch& surface, int first, int count, std::size_t at, LensMap& map);

/// Stores the passes alone of a ray: not s, t and valid, nor the shadow.
void store_passes(const SurfaceBatch& surface, int ray, std::size_t at, LensMap& map);

/// Does a channel say something of the point that is seen? (The others are of the ray, wherever it goes.)
bool is_of_surface(std::string_view channel);

}  // namespace lensplane
