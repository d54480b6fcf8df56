// SPDX-License-Identifier: Apache-2.0
//
// What POV-Ray has to render for a layer and a frame, and the fingerprint of everything that determines it.

#pragma once

#include <string>
#include <vector>

#include "pipeline/povray/camera_include.h"
#include "pipeline/povray/povray.h"
#include "pipeline/povray/scene_files.h"
#include "pipeline/shot/shot.h"
#include "src/plan.h"

namespace lensplane {

/// One picture that POV-Ray makes; a plate is the mean of several where the shutter or the antialiasing of
/// bent rays asks for that.
struct PlatePass {
  SceneFacts facts;
  Plan plan;                        // of bent rays
  FilmPosition in_pixel{0.5, 0.5};  // where in their pixels bent rays begin
};

/// A plate in the making.
struct PlateTask {
  std::size_t layer = 0;  // an index into Shot::layers
  int frame = 0;
  Camera camera;      // as large as what is rendered
  int antialias = 1;  // of POV-Ray
  double clock = 0;   // from 0 at the shot's first frame to 1 at its last
  std::vector<PlatePass> passes;
  std::string digest;
};

/// What has to be rendered. `files` are those of the layer's scene. Throws Failure (BadShot).
PlateTask plate_task(const Shot& shot, std::size_t layer, int frame, const SceneFiles& files,
                     const PovRay& povray);

}  // namespace lensplane
