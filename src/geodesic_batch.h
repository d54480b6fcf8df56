// SPDX-License-Identifier: Apache-2.0
//
// Many curved rays at once: the fast path of geodesic.h.
//
// A step waits for one root and one division after the other; rays side by side fill that time. Each lane is
// a ray with its own length of step, and is given the next ray as soon as its own has ended. The operations
// are those of geodesic_step.h in the same order: results are the same, bit for bit.

#pragma once

#include "src/geodesic.h"

namespace lensplane {

/// What trace_geodesic() makes of each of `directions`.
template <class N>
std::vector<GeodesicRay<N>> trace_geodesics(std::span<const PointMass> masses, const Vector<N>& start,
                                            std::span<const Vector<N>> directions, double tolerance,
                                            const Bodies& bodies = {}, const RayNeeds& needs = {});

}  // namespace lensplane
