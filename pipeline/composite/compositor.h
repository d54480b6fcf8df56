// SPDX-License-Identifier: Apache-2.0
//
// From what rays meet to a picture: every layer looked up through the trace, laid over one another by depth.
//
// The compositor asks the tracer for kRaysPerAxis x kRaysPerAxis rays in each pixel and averages them (a box
// filter one pixel wide). Everything is linear light in the working space, premultiplied by alpha.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/composite/texture.h"
#include "src/tracer.h"

namespace lensplane {

inline constexpr int kRaysPerAxis = 4;
inline constexpr int kRaysPerPixel = kRaysPerAxis * kRaysPerAxis;
static_assert(kBatchSize % kRaysPerPixel == 0, "a batch holds whole pixels");

/// What a surface of the scene looks like.
struct SurfaceLook {
  std::shared_ptr<const Texture> texture;
  std::optional<Vec3>
      light;  // spheres: unit vector towards the light in the sphere's own axes, for Lambert shading
};

struct Composite {
  Picture picture;                 // the overscan included
  std::vector<std::int64_t> hits;  // per surface: rays inside the frame, without overscan, that meet it
};

/// The picture that the tracer's camera takes; `looks` in the order of its surfaces.
/// Nearer surfaces lie over farther ones; at infinity plates lie over skies, and later ones over earlier
/// ones. Where a ray meets nothing the picture is transparent black. Runs in parallel; the picture does not
/// depend on the number of threads.
Composite composite(const Tracer& tracer, const std::vector<SurfaceLook>& looks);

/// The rays of composite() that meet each surface, without a picture.
std::vector<std::int64_t> count_hits(const Tracer& tracer);

}  // namespace lensplane
