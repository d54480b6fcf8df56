// SPDX-License-Identifier: Apache-2.0
//
// Six scenes that are hard to draw, small enough for a truth of very many rays: what a doubting supervisor
// would try first.
//
// Their pictures have about four texels or more to a pixel, so that little depends on how a texture is
// thought of between its texels, or on what its own pixels have been filtered by.

#pragma once

#include <string>
#include <vector>

#include "src/scene.h"
#include "tests/quality/ways.h"

namespace lensplane {

struct HardScene {
  std::string name;
  Scene scene;
  std::vector<Seen> surfaces;  // in the order of the scene's
};

std::vector<HardScene> hard_scenes();

}  // namespace lensplane
