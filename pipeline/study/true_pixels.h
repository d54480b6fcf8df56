// SPDX-License-Identifier: Apache-2.0
//
// The truth that pictures are measured against: squares of pixels, spread over the frame, seen by very many
// rays each, every one a point, weighted by the pixel filter less the pictures' own (composite/footprint.h).

#pragma once

#include <vector>

#include "pipeline/composite/layering.h"
#include "src/tracer.h"

namespace lensplane {

/// A square of true pixels of the frame.
struct TrueTile {
  int left = 0;
  int top = 0;
  int size = 0;              // pixels each way
  std::vector<Rgba> pixels;  // row by row
};

/// `across` x `across` squares of 16 pixels each way, fewer where they would overlap, evenly spread over the
/// frame without its overscan; every pixel by `rays` x `rays` rays within it, and those of its neighbours
/// that the filter reaches. The tracer's plan has to call for the Jacobian, from which a picture's own
/// filter is known. `looks` in the order of the surfaces. Runs in parallel.
std::vector<TrueTile> true_tiles(const Tracer& tracer, const std::vector<SurfaceLook>& looks, int across,
                                 int rays);

/// No picture is called better than this, in decibels.
inline constexpr double kLargestPsnr = 150;

/// Peak signal to noise of linear light at the tiles' pixels, in decibels; the peak is the brightest of the
/// truth.
double psnr_of(const Picture& picture, const std::vector<TrueTile>& truth);

}  // namespace lensplane
