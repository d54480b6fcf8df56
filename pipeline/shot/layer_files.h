// SPDX-License-Identifier: Apache-2.0
//
// The files that a layer is made from.

#pragma once

#include <vector>

#include "pipeline/shot/shot.h"

namespace lensplane {

/// The images of a layer: its own, then that of a sphere's night. Stars have none.
std::vector<const LayerImage*> images_of(const Layer& layer);

/// All files: its images, or the catalogue of stars.
std::vector<LocatedText*> files_of(Layer& layer);
std::vector<const LocatedText*> files_of(const Layer& layer);

}  // namespace lensplane
