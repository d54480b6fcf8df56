// SPDX-License-Identifier: Apache-2.0
//
// How much light a ball leaves to a ring behind it.
//
// The light comes from one direction, so the shadow is a cylinder. Its edge is as wide as what is seen at
// once: the share of the pixel filter outside of it, across the shadow at the middle of the filter, whose
// edge is straight there but for its curve within a pixel.

#pragma once

#include "pipeline/composite/layering.h"

namespace lensplane {

/// From 0 to 1 at a point of the ring, under a footprint; without width 0 or 1. `light` and `caster` in the
/// ring's own axes.
double light_share(const Ring& ring, const ShadowCaster& caster, const Vec3& light, TextureCoordinates st,
                   const Footprint& footprint);

}  // namespace lensplane
