// SPDX-License-Identifier: Apache-2.0
//
// The truth that pictures are measured against: 32 x 32 rays in every pixel, each a point lookup into the
// plate's bilinear surface, weighted by a filter.

#pragma once

#include "pipeline/composite/texture.h"
#include "src/tracer.h"

namespace lensplane {

/// Rays per pixel and axis.
inline constexpr int kTruthRays = 32;

struct Truth {
  Picture by_pixel_filter;  // the Gaussian of kPixelSigma that lensplane documents as its own
  Picture by_box;           // one pixel wide
};

/// The frame of a scene with one plate.
Truth true_picture(const Tracer& tracer, const Texture& plate);

}  // namespace lensplane
