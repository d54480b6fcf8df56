// SPDX-License-Identifier: Apache-2.0
//
// PNG files for people to look at.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/image/picture.h"

namespace lensplane {

/// What a file says about itself.
struct PngHeader {
  std::string parameters = {};  // for read_png_parameters
  bool srgb = true;             // whether the colours are sRGB; else the file does not say what they are
};

/// Writes display-referred colours (0 to 1; what lies outside is clamped) as 8-bit RGB, dithered against
/// banding, whole or not at all. Returns its size in bytes. Throws Failure (BadOutput).
std::size_t write_png(const std::filesystem::path& path, const Picture& picture, const PngHeader& header);

/// The `parameters` of a file written by write_png; nothing when there is no such file or it is not whole.
std::optional<std::string> read_png_parameters(const std::filesystem::path& path);

}  // namespace lensplane
