// SPDX-License-Identifier: Apache-2.0
//
// How much light a ball leaves to a ring behind it.
//
// Light from a point comes from one direction, and its shadow is a cylinder. Its edge is as wide as what is
// seen at once: the share of the pixel filter outside of it, across the shadow at the middle of the filter,
// whose edge is straight there but for its curve within a pixel. Light from a disc leaves a penumbra, which
// is looked at in sixteen places across it.

#pragma once

#include "pipeline/composite/layering.h"

namespace lensplane {

/// From 0 to 1 at a point of the ring, under a footprint; `sun`: the angular radius of the light's disc,
/// radians, or 0 for a point. `light` and `caster` in the ring's own axes.
double light_share(const Ring& ring, const ShadowCaster& caster, const Vec3& light, double sun,
                   TextureCoordinates st, const Footprint& footprint);

}  // namespace lensplane
