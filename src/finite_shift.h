// SPDX-License-Identifier: Apache-2.0
//
// What the finite distance of a light source changes: near the masses light is not where its straight
// stretches say.

#pragma once

#include <cstddef>
#include <optional>

#include "src/deflectors.h"
#include "src/dual.h"

namespace lensplane {

/// By how much the light's true path lies beside its straight stretch, towards the masses, where it enters
/// the ball or is nearest to its centre: what the finite distance of a light source changes, to first order
/// in m. `start` and `direction` are the stretch's; `bent` is how many of the planes have bent it, nothing
/// for light that has turned back: that is taken to have been bent by the masses that lie behind it.
template <class Number>
Vector<Number> finite_shift(const Deflectors& deflectors, std::optional<std::size_t> bent,
                            const Vector<Number>& start, const Vector<Number>& direction,
                            const Sphere& sphere);

}  // namespace lensplane
