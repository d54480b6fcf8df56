// SPDX-License-Identifier: Apache-2.0
//
// Bent rays as POV-Ray's mesh camera takes them: one small triangle for each pixel, with the ray's start in
// its middle and the ray's direction as its normal.
//
// POV-Ray keeps triangles and their normals as single floats. The mesh is written in camera axes, from the
// depth at which most rays start, and a matrix moves it into the world in double precision: so a ray's slope
// is off by about 1e-7 of itself, however narrow the view, and a start by as much of how far it is from the
// axis.

#pragma once

#include <iosfwd>
#include <span>

#include "src/outgoing_rays.h"

namespace lensplane {

/// How far a ray's slopes to the camera's axis are off in the mesh, as a share of the largest slope of those
/// that start about as deep; and how far it passes from where it should, as a share of how far from the axis
/// most start.
inline constexpr double kMeshError = 5e-7;

/// Writes the text of lensplane_rays.inc, which declares the mesh `lensplane_rays`; pixels row by row. Pixels
/// without light get any ray: what they show means nothing. Lengths in the scene's unit.
void write_ray_mesh(const Camera& camera, std::span<const OutgoingRay> rays, double unit_m, std::ostream& to);

}  // namespace lensplane
