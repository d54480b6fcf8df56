// SPDX-License-Identifier: Apache-2.0
//
// From what rays meet to a picture: the film tile by tile, each pixel filtered by its Jacobian, and more rays
// where that is not enough.
//
// Most pixels are seen by one ray, whose footprint on every surface is filtered. Pixels that hold an edge
// (see edge_finder.h) get sixteen rays, and as many as the shot allows when those leave too much to chance
// (see edge_pixel.h).
// Everything is linear light in the working space, premultiplied by alpha.

#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/composite/empty_space.h"
#include "pipeline/composite/layering.h"
#include "pipeline/composite/sample_pattern.h"
#include "src/tracer.h"

namespace lensplane {

/// A picture that is transparent where light ends in a mass, and where that is.
struct ShadowedPicture {
  Picture picture;            // the overscan included
  std::vector<float> shadow;  // share of every pixel whose light ends in a mass and is not covered before
};

struct Composite : ShadowedPicture {
  std::vector<double> hits;     // per surface: how many pixels of the frame, without overscan, it covers
  std::int64_t rays = 0;        // all that were traced
  std::int64_t unresolved = 0;  // of them, given up: they see nothing
  std::int64_t refined = 0;     // pixels that got more than one ray
};

/// The picture that the tracer's camera takes; `looks` in the order of its surfaces. The tracer's plan has to
/// call for the Jacobian. Where a ray meets nothing, or ends in a mass, the picture is transparent black.
/// `empty`: what is known already of what this tracer's rays meet. Runs in parallel; the picture depends
/// neither on the number of threads nor on what is known.
Composite composite(const Tracer& tracer, const std::vector<SurfaceLook>& looks, const Sampling& sampling,
                    const EmptySpace& empty = {});

/// Makes the places where light ends black and opaque: the shadow is added to the alpha.
void blacken_shadow(ShadowedPicture& result);

/// Multiplies the light of a picture by 2^stops; alpha stays as it is.
void expose(double stops, Picture& picture);

/// Adds all of `other`, which has the same windows and surfaces, to `sum`; multiplies pictures and hits. The
/// mean of several is a picture taken over time.
void add(const Composite& other, Composite& sum);
void scale(double by, Composite& composite);

/// Transparent black, overscan included.
Picture blank_picture(const Camera& camera);

}  // namespace lensplane
