// SPDX-License-Identifier: Apache-2.0
//
// Pictures from maps on disk, whoever made or edited them: no light is traced, every pixel of a map is looked
// up once, over its footprint.
//
// A pixel has one (s, t) and a coverage: edges are as soft as the map's coverage, and not softer; which part
// of the pixel that is, coverage_mask.h reads from its neighbours. (What is traced by compositor.h has many
// rays in each pixel.)

#pragma once

#include <vector>

#include "pipeline/composite/compositor.h"
#include "pipeline/composite/footprint.h"
#include "pipeline/image/map_reader.h"

namespace lensplane {

/// A layer as its map has it.
struct MapLayer {
  StMap map;
  std::vector<Footprint> footprints;
  Surface surface = Plate{};
  SurfaceLook look;
  std::vector<float> depth;  // metres along the ray, the largest float at infinity; empty: `distance`
  double distance = 0;       // metres to its centre; infinite for plates and skies
};

/// The layers over one another: nearer ones over farther ones, at infinity plates over skies, at the same
/// distance later layers over earlier ones. Coverage counts like alpha. All maps have the same windows, which
/// are the picture's; there is at least one. Runs in parallel.
Picture composite_from_maps(const std::vector<MapLayer>& layers);

}  // namespace lensplane
