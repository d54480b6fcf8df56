// SPDX-License-Identifier: Apache-2.0
//
// Every way of making the picture of a scene: ours, and those of peers from our maps.

#pragma once

#include <vector>

#include "pipeline/composite/layering.h"
#include "src/lens_map.h"
#include "src/tracer.h"
#include "tests/quality/truth.h"

namespace lensplane {

/// What stands on a surface: what lensplane looks up, and the picture that it was made of, for the peers.
struct Seen {
  SurfaceLook look;
  Picture picture;
  Wrap edge = Wrap::Black;
};

Seen seen(Picture picture, Wrap edge);

std::vector<SurfaceLook> looks_of(const std::vector<Seen>& surfaces);

/// By the plan, with all that a picture, comp and warp need.
Tracer tracer_of(const Scene& scene);

/// As lensplane map makes them, with filtered coverage.
std::vector<LensMap> maps_of(const Tracer& tracer);

/// As lensplane comp makes it: from maps and their data files. `surfaces` in the order of the scene's.
Picture by_comp(const Tracer& tracer, const std::vector<LensMap>& maps, const std::vector<Seen>& surfaces);

/// As lensplane warp makes it with a map's data file; layers over one another, the last on top.
Picture by_warp(const std::vector<LensMap>& maps, const std::vector<Seen>& surfaces);

/// A frame by every way of making it; layers over one another, the last on top.
struct Frame {
  std::vector<LensMap> maps;
  Truth truth;
  Picture render, comp, warp;
  std::vector<Picture> st_warp;  // by its default filter and by the triangle
  Picture area, supersampled;
};

/// `rays`: of the truth, per pixel and axis.
Frame make_frame(const Scene& scene, const std::vector<Seen>& surfaces, int rays = kTruthRays);

}  // namespace lensplane
