// SPDX-License-Identifier: Apache-2.0
//
// Image files larger than memory, read tile by tile through an ImageCache.

#pragma once

#include "pipeline/image/tiled_image.h"

namespace lensplane::oiio {

/// As pipeline/image/tiled_image.h has them.
bool is_larger_than_memory(const std::filesystem::path& path, const ImageChoice& choice);
std::shared_ptr<const TiledImage> open_tiled_image(const std::filesystem::path& path, std::size_t cache_bytes,
                                                   const ImageChoice& choice);

}  // namespace lensplane::oiio
