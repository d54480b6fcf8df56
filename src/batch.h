// SPDX-License-Identifier: Apache-2.0
//
// Batches: many rays side by side in arrays of a fixed size, so that each step is a plain loop without
// branches which the compiler turns into vector instructions.
//
// Kernels use additions, multiplications, divisions, square roots and operations on bits only: a ray's result
// does not depend on its neighbours, nor on the width of the vectors. Where multiplications and additions are
// fused (CMakeLists.txt), processors without that instruction give other last digits, but those are rounding.

#pragma once

#include "src/dual.h"
#include "src/inlining.h"

namespace lensplane {

/// Small enough that all that a kernel touches stays in the nearest cache.
inline constexpr int kBatchSize = 128;

using BatchArray = double[kBatchSize];

/// Is any of a batch's flags (0 or 1) set? Without an early end, which would be slower.
bool any_of(const BatchArray& flags);

/// A number of either kind for each ray of a batch.
template <class Number>
struct Lane;

template <>
struct Lane<double> {
  alignas(64) BatchArray v;

  LENSPLANE_ALWAYS_INLINE double get(int i) const { return v[i]; }
  LENSPLANE_ALWAYS_INLINE void set(int i, double a) { v[i] = a; }
};

template <>
struct Lane<Dual> {
  alignas(64) BatchArray v, dx, dy;

  LENSPLANE_ALWAYS_INLINE Dual get(int i) const { return {v[i], dx[i], dy[i]}; }
  LENSPLANE_ALWAYS_INLINE void set(int i, const Dual& a) {
    v[i] = a.v;
    dx[i] = a.dx;
    dy[i] = a.dy;
  }
};

/// A vector for each ray of a batch.
template <class Number>
struct VectorLane {
  Lane<Number> x, y, z;

  LENSPLANE_ALWAYS_INLINE Vector<Number> get(int i) const { return {x.get(i), y.get(i), z.get(i)}; }
  LENSPLANE_ALWAYS_INLINE void set(int i, const Vector<Number>& a) {
    x.set(i, a.x);
    y.set(i, a.y);
    z.set(i, a.z);
  }
};

}  // namespace lensplane

// Each kernel is compiled for these instruction sets; the loader picks one. Sanitizers are not up when it
// does; LENSPLANE_BASELINE leaves only what every processor has, to compare with.
#if defined(__x86_64__) && !defined(LENSPLANE_SANITIZE) && !defined(LENSPLANE_BASELINE)
#define LENSPLANE_KERNEL [[gnu::target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")]]
#else
#define LENSPLANE_KERNEL
#endif
