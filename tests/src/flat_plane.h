// SPDX-License-Identifier: Apache-2.0
//
// Planes parallel to the screen, for tests that write them down.

#pragma once

#include <vector>

#include "src/lens_planes.h"

namespace lensplane {

struct SourceAside {
  double m, x, y;
};

inline Source source_at(double z, const SourceAside& source) {
  return {source.m, {source.x, source.y, z}};
}

/// The plane at `z` and its sources.
inline LensPlane flat_plane(double z, const std::vector<SourceAside>& sources) {
  LensPlane plane{{0, 0, -1}, -z, {}};
  for (const SourceAside& source : sources) plane.sources.push_back(source_at(z, source));
  return plane;
}

}  // namespace lensplane
