// SPDX-License-Identifier: Apache-2.0
//
// The truth that pictures are measured against: very many rays in every pixel, each a point lookup into what
// it meets, weighted by a filter.
//
// The rays lie in equal cells of the film, in each at a place of its own drawn by chance: none of the
// renderer's points, estimates or footprints are used. A pixel's filter reaches over the cells of sixteen
// pixels.

#pragma once

#include <vector>

#include "pipeline/composite/layering.h"
#include "src/tracer.h"

namespace lensplane {

/// Rays per pixel and axis, where nothing else is said.
inline constexpr int kTruthRays = 32;

struct Truth {
  Picture by_pixel_filter;  // the Gaussian of kPixelSigma, less the pictures' own, as docs/numerics.md says
  Picture by_box;           // one pixel wide
};

/// The tracer's plan has to call for the Jacobian, from which a picture's own filter is known. The frame that
/// the tracer's camera takes, without overscan; `looks` in the order of its surfaces. Runs in parallel;
/// depends on nothing else.
Truth true_picture(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int rays = kTruthRays);

}  // namespace lensplane
