// SPDX-License-Identifier: Apache-2.0
//
// The camera that an EXR file says it was rendered with: worldToCamera and worldToNDC of its header, read
// without its pixels.
//
// Both are matrices for row vectors. The world is right-handed. A camera space of the same hand looks along
// its -z, as lensplane, Arnold and OpenGL have it; one of the other hand along its +z, as OpenEXR's
// description and RenderMan have it: the determinant tells which. x is to the right, y up in both. worldToNDC
// is worldToCamera times a projection to the display window, whose middle is at 0 (from -1 to 1) or at 0.5
// (from 0 to 1, as OpenEXR describes it): where the camera's axis comes out tells which.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "src/basis.h"

namespace lensplane {

struct ExrCamera {
  Vec3 position{0};                      // in the file's unit of length
  Basis axes;                            // world from camera, looking along -z
  std::optional<double> half_width_tan;  // tangent of half the field of view across; nothing: no worldToNDC
  double height_to_width = 0;            // of what is seen, where that is known
};

/// The matrices may be off by so much, as float32 is after a few products.
inline constexpr double kCameraMatrixError = 1e-4;

/// The camera of a part, by its name or its number from 0 (empty: the first). Throws Failure (BadInput) when
/// the file is no EXR, has no worldToCamera, this is no rotation and shift, or worldToNDC no perspective in
/// the middle of whose picture the camera's axis comes out.
ExrCamera read_exr_camera(const std::filesystem::path& path, const std::string& part = {});

}  // namespace lensplane
