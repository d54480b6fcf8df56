// SPDX-License-Identifier: Apache-2.0
//
// The locator: a picture of where the lenses are, seen by the shot's camera as if no light were bent.
//
// The layers stand where they are; every lens that the camera can see is drawn as a coloured bubble of one
// size in space, so that farther ones look smaller. The bubbles are markers: they are in no map and no
// simulation.

#pragma once

#include <vector>

#include "pipeline/composite/compositor.h"

namespace lensplane {

struct LocatorView {
  Scene scene;                     // without lenses, the markers behind the layers in the list of surfaces
  std::vector<SurfaceLook> looks;  // for all of its surfaces
};

/// The locator of a scene whose surfaces look like `looks`.
LocatorView make_locator(const Scene& scene, const std::vector<SurfaceLook>& looks);

}  // namespace lensplane
