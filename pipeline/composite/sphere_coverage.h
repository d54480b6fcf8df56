// SPDX-License-Identifier: Apache-2.0
//
// How large a sphere appears when no light is bent: what amplification is measured against.

#pragma once

#include "pipeline/composite/sample_pattern.h"
#include "src/scene.h"

namespace lensplane {

/// Pixels of the frame, without overscan, that the sphere covers when light runs straight; pixels at its edge
/// by the share of their rays that meet it, as the compositor counts. Runs in parallel.
double covered_without_lenses(const Camera& camera, const Sphere& sphere, const Sampling& sampling);

}  // namespace lensplane
