// SPDX-License-Identifier: Apache-2.0
//
// Camera tracks as .chan files exchange them: a line for each frame,
//
//     frame tx ty tz rx ry rz [vfov]
//
// in the file's own unit of length and in degrees, rotated in the order ZXY, with the vertical field of view.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/basis.h"

namespace lensplane {

/// A camera at a frame, in the numbers of the file.
struct ChanKey {
  double frame = 0;
  Vec3 position{0};
  Vec3 rotation_deg{0};
  std::optional<double> vertical_fov_deg;
};

/// Reads the lines of a file, of which there is at least one, by ascending frames. Empty lines, and what
/// follows a #, say nothing. Either all lines have a field of view or none. Throws Failure (BadInput) that
/// names the line and the word.
std::vector<ChanKey> read_chan(const std::filesystem::path& path);

/// The text of a file that says as much, with all digits.
std::string chan_text(const std::vector<ChanKey>& keys);

}  // namespace lensplane
