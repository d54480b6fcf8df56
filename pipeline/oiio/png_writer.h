// SPDX-License-Identifier: Apache-2.0
//
// PNG files in memory.

#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/image/display_writer.h"

namespace lensplane::oiio {

/// What ImageLibrary says.
std::vector<unsigned char> png_bytes(const std::filesystem::path& path, const Picture& picture, int bits,
                                     const DisplayHeader& header);

}  // namespace lensplane::oiio
