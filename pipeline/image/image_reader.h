// SPDX-License-Identifier: Apache-2.0
//
// Image files as they are on disk.

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "pipeline/image/encoded_image.h"
#include "pipeline/image/image_choice.h"
#include "pipeline/image/image_outline.h"

namespace lensplane {

/// Larger images are refused: they would not fit into memory as they are worked with.
inline constexpr std::size_t kMaxImagePixels = std::size_t{1} << 29;

/// Reads an image. EXR and whatever else OpenImageIO reads. A layer without an alpha of its own has the
/// part's. Throws Failure (BadInput) with the path and the reason: which layers and parts there are, if there
/// is not the one that is chosen.
EncodedImage read_image(const std::filesystem::path& path, const ImageChoice& choice = {});

/// The same without its pixels, from its header alone. Throws Failure (BadInput) as read_image.
ImageOutline read_outline(const std::filesystem::path& path, const ImageChoice& choice = {});

/// The colorInteropID that an image says about itself, read from its header alone; empty when it says none,
/// or cannot be read.
std::string read_interop_id(const std::filesystem::path& path);

}  // namespace lensplane
