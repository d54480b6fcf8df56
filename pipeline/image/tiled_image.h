// SPDX-License-Identifier: Apache-2.0
//
// Image files larger than memory: tiled, with their pyramid in the file, read tile by tile.
//
// `maketx` writes such files (.tx; TIFF or EXR inside). OpenImageIO's ImageCache keeps them open and holds
// what it reads within a budget of its own. Values are as stored, as in encoded_image.h.

#pragma once

#include <OpenImageIO/oiioversion.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/image/pixel_layout.h"

OIIO_NAMESPACE_BEGIN
class ImageCache;
OIIO_NAMESPACE_END

namespace lensplane {

/// Images with more pixels than this are not read whole: with their pyramid they would take more than 2.7 GB.
inline constexpr std::size_t kMostPixelsInMemory = std::size_t{1} << 27;

/// Whether an image has more pixels than kMostPixelsInMemory. Reads the header only. Throws Failure
/// (BadInput).
bool is_larger_than_memory(const std::filesystem::path& path);

/// Safe to use from many threads.
class TiledImage {
 public:
  struct Level {
    int width = 0;
    int height = 0;
  };

  /// Throws Failure (BadInput) that names `maketx` when the file is not tiled, or has no pyramid, and with
  /// the reason when it cannot be used: pixels outside of its display window, or no colours in it.
  /// `cache_bytes`: what the ImageCache may hold.
  TiledImage(const std::filesystem::path& path, std::size_t cache_bytes);

  /// The finest first.
  const std::vector<Level>& levels() const { return levels_; }
  int tile_width() const { return tile_width_; }
  int tile_height() const { return tile_height_; }

  /// The tile at a column and a row of tiles, cut off at the edges of the level. Throws Failure (BadInput).
  EncodedImage tile(int level, int column, int row) const;

 private:
  std::string path_;
  std::shared_ptr<OIIO::ImageCache> cache_;
  std::vector<Level> levels_;
  int tile_width_ = 0;
  int tile_height_ = 0;
  PixelLayout layout_;
};

}  // namespace lensplane
