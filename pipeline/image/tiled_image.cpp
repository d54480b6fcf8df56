// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/tiled_image.h"

#include "pipeline/image/image_library.h"

namespace lensplane {

bool is_larger_than_memory(const std::filesystem::path& path, const ImageChoice& choice) {
  return image_library().is_larger_than_memory(path, choice);
}

std::shared_ptr<const TiledImage> open_tiled_image(const std::filesystem::path& path, std::size_t cache_bytes,
                                                   const ImageChoice& choice) {
  return image_library().open_tiled_image(path, cache_bytes, choice);
}

}  // namespace lensplane
