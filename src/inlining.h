// SPDX-License-Identifier: Apache-2.0
//
// What loops over batches are made of is always inlined: a loop with a call in it is not vectorised.
// LENSPLANE_FLATTEN inlines all that a function calls.
//
// Under the sanitizers nothing is vectorised, and checks of one large function take minutes to compile.

#pragma once

#ifdef LENSPLANE_SANITIZE
#define LENSPLANE_ALWAYS_INLINE
#define LENSPLANE_FLATTEN
#else
#define LENSPLANE_ALWAYS_INLINE __attribute__((always_inline))
#define LENSPLANE_FLATTEN __attribute__((flatten))
#endif
