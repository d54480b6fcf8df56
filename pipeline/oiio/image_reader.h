// SPDX-License-Identifier: Apache-2.0
//
// Image files as they are on disk.

#pragma once

#include <filesystem>
#include <string>

#include "pipeline/image/encoded_image.h"
#include "pipeline/image/image_choice.h"
#include "pipeline/image/image_outline.h"

namespace lensplane::oiio {

/// As pipeline/image/image_reader.h has it.
EncodedImage read_image(const std::filesystem::path& path, const ImageChoice& choice);

ImageOutline read_outline(const std::filesystem::path& path, const ImageChoice& choice);

/// What ImageLibrary says.
std::string read_attribute(const std::filesystem::path& path, const char* name);

}  // namespace lensplane::oiio
