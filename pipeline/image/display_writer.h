// SPDX-License-Identifier: Apache-2.0
//
// Pictures for people to look at: PNG of 8 or 16 bits and TIFF of 16, which say what their numbers mean.

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/image/picture.h"

namespace lensplane {

/// What a file says about itself.
struct DisplayHeader {
  std::string parameters = {};          // for read_display_parameters
  std::string colour_interop = {};      // colorInteropID: "srgb_rec709_display"; empty when not known
  std::vector<unsigned char> icc = {};  // a profile; empty when there is none
};

/// Writes display-referred colours (0 to 1; what lies outside is clamped) without alpha, whole or not at all:
/// a TIFF of 16 bits where the path ends in .tif or .tiff, else a PNG of `bits`, 8 or 16. 8 bits are dithered
/// against banding, always the same way; 16 are rounded. Returns the file's size in bytes. Throws Failure
/// (BadOutput).
std::size_t write_display(const std::filesystem::path& path, const Picture& picture, int bits,
                          const DisplayHeader& header);

/// Whether write_display would write a TIFF.
bool is_tiff(const std::filesystem::path& path);

/// The `parameters` of a file that write_display wrote; nothing when there is no such file or it is not
/// whole.
std::optional<std::string> read_display_parameters(const std::filesystem::path& path);

}  // namespace lensplane
