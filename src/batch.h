// SPDX-License-Identifier: Apache-2.0
//
// Batches: many rays side by side in arrays of a fixed size, so that each step is a plain loop without
// branches which the compiler turns into vector instructions.
//
// Kernels use additions, multiplications, divisions and square roots only, none of them contracted: every
// instruction set gives the same bits, and a ray's result does not depend on its neighbours.

#pragma once

namespace lensplane {

inline constexpr int kBatchSize = 256;

using BatchArray = double[kBatchSize];

}  // namespace lensplane

// Each kernel is compiled for these instruction sets; the loader picks one. Sanitizers are not up when it
// does.
#if defined(__x86_64__) && !defined(LENSPLANE_SANITIZE)
#define LENSPLANE_KERNEL [[gnu::target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")]]
#else
#define LENSPLANE_KERNEL
#endif
