// SPDX-License-Identifier: Apache-2.0
//
// Many rays at once by the method `planes`: the fast path of planes_march.h.
//
// The steps are those of planes_march.h, each for a whole batch, by a kernel that is compiled for what is
// asked of it: the kind of number (with derivatives or without), the law, how far the light stays from the
// mass, whether the camera's distance counts, and whether the length of the path does. What is not asked for
// is not in the kernel.
//
// A ray for which a kernel would not do is marked irregular; its numbers mean nothing. Kernels for light far
// from the masses leave to those for light near them whatever bends by more than kShortTurn or passes within
// b_c/kFarRatio; those leave to march_planes() whatever may turn back to further planes.

#pragma once

#include "src/deflectors.h"
#include "src/line_batch.h"

namespace lensplane {

/// How near to the masses light may come.
enum class Reach { Far, Near };

/// Batches and march_planes() agree on the direction, per bend, to this share of 1 + alpha. Close to b_c
/// alpha itself knows no more digits than b does: kFarError and kExactLawError on top, in b.
inline constexpr double kPlanesBatchError = 1e-15;

/// What is asked of the kernels.
struct PlanesWork {
  Reach reach = Reach::Far;
  bool path = false;     // fill LineBatch::path
  bool shapiro = false;  // fill LineBatch::shapiro; needs path
};

/// Takes the rays past the outward plane number `plane`.
template <class Number>
void pass_plane(const Deflectors& deflectors, std::size_t plane, const PlanesWork& work,
                LineBatch<Number>& rays);

}  // namespace lensplane
