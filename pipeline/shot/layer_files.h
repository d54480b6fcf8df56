// SPDX-License-Identifier: Apache-2.0
//
// The files that a layer is made from.

#pragma once

#include <vector>

#include "pipeline/shot/shot.h"

namespace lensplane {

/// The images of a layer: its own, then that of a sphere's night. Stars have none.
std::vector<const LayerImage*> images_of(const Layer& layer);

/// All files that it is made from, as the shot names them: its images, the catalogue of stars, or the scene
/// that POV-Ray renders.
std::vector<LocatedText*> files_of(Layer& layer);
std::vector<const LocatedText*> files_of(const Layer& layer);

/// Lets the images of POV-Ray's layers lie in the folder for output, as SHOT.LAYER.plate.####.exr. To be
/// called again when that folder changes.
void put_plates(Shot& shot);

}  // namespace lensplane
