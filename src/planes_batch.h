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

#include "src/batch.h"
#include "src/deflectors.h"
#include "src/projection.h"

namespace lensplane {

/// How near to the masses light may come.
enum class Reach { Far, Near };

/// Batches and march_planes() agree on the direction, per bend, to this share of 1 + alpha. Close to b_c
/// alpha itself knows no more digits than b does: kFarError and kExactLawError on top, in b.
inline constexpr double kPlanesBatchError = 1e-15;

/// A batch of rays on their way.
template <class Number>
struct LineBatch {
  VectorLane<Number> start;          // metres, camera axes
  VectorLane<Number> direction;      // unit vectors
  VectorLane<double> first;          // their directions at the camera, where there is no flat screen
  Lane<double> path;                 // metres along the ray from the camera to `start`, when it is asked for
  Lane<double> shapiro;              // metres of Shapiro delay so far, when the arrival time is asked for
  alignas(64) BatchArray irregular;  // 0, or 1 when this kernel does not do for the ray
  alignas(64) BatchArray captured;   // 0 or 1
};

/// What is asked of the kernels.
struct PlanesWork {
  Reach reach = Reach::Far;
  bool path = false;     // fill LineBatch::path
  bool shapiro = false;  // fill LineBatch::shapiro; needs path
};

/// Rays from the camera through the film positions (x[i], y[i]).
template <class Number>
void start_lines(const Camera& camera, const BatchArray& x, const BatchArray& y, LineBatch<Number>& rays);

/// Takes the rays past the outward plane number `plane`.
template <class Number>
void pass_plane(const Deflectors& deflectors, std::size_t plane, const PlanesWork& work,
                LineBatch<Number>& rays);

}  // namespace lensplane
