// SPDX-License-Identifier: Apache-2.0
//
// Image files larger than memory: tiled, with their pyramid in the file, read tile by tile.
//
// `maketx` writes such files (.tx; TIFF or EXR inside). OpenImageIO's ImageCache keeps them open and holds
// what it reads within a budget of its own. Values are as stored, as in encoded_image.h.

#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/image/encoded_image.h"
#include "pipeline/image/image_choice.h"

namespace lensplane {

/// Images with more pixels than this are not read whole: with their pyramid they would take more than 2.7 GB.
inline constexpr std::size_t kMostPixelsInMemory = std::size_t{1} << 27;

/// Whether an image has more pixels than kMostPixelsInMemory. Reads the header only. Throws Failure
/// (BadInput).
bool is_larger_than_memory(const std::filesystem::path& path, const ImageChoice& choice = {});

/// Safe to use from many threads.
class TiledImage {
 public:
  struct Level {
    int width = 0;
    int height = 0;
  };

  virtual ~TiledImage() = default;

  /// The finest first.
  virtual const std::vector<Level>& levels() const = 0;
  virtual int tile_width() const = 0;
  virtual int tile_height() const = 0;

  /// The tile at a column and a row of tiles, cut off at the edges of the level. Throws Failure (BadInput).
  virtual EncodedImage tile(int level, int column, int row) const = 0;
};

/// Throws Failure (BadInput) that names `maketx` when the file is not tiled, or has no pyramid, and with the
/// reason when it cannot be used: pixels outside of its display window, or no colours in it. `cache_bytes`:
/// what the ImageCache may hold.
std::shared_ptr<const TiledImage> open_tiled_image(const std::filesystem::path& path, std::size_t cache_bytes,
                                                   const ImageChoice& choice = {});

}  // namespace lensplane
