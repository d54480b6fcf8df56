// SPDX-License-Identifier: Apache-2.0
//
// Stars in a picture: found behind the lenses, dimmed by what stands in front of them, drawn.

#pragma once

#include <vector>

#include "pipeline/composite/layering.h"
#include "pipeline/composite/star_images.h"

namespace lensplane {

/// Takes off the light of `images` what the surfaces of `tracer` hide of it: everything but the skies, by its
/// alpha along the ray of each image. `looks` in the order of the surfaces; the tracer's plan has to call for
/// the Jacobian. Runs in parallel.
void dim_hidden(const Tracer& tracer, const std::vector<SurfaceLook>& looks, std::vector<StarImage>& images);

/// Adds the light of every image of `field` that is not hidden to the picture; see StarImage, draw_stars().
void add_stars(const Tracer& tracer, const std::vector<SurfaceLook>& looks, const StarField& field,
               Picture& picture);

}  // namespace lensplane
