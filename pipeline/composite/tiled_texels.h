// SPDX-License-Identifier: Apache-2.0
//
// Textures larger than memory: tiles come from their file when a lookup asks for them, are brought into the
// working space, and are kept in a TileCache.
//
// Levels are the file's. Where they are made by boxes (as maketx does) more of what a coarse level cannot
// hold shows in them as moire than in the pyramids made here.

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "pipeline/composite/texels.h"
#include "pipeline/composite/tile_cache.h"
#include "pipeline/image/tiled_image.h"

namespace lensplane {

/// What OpenImageIO may hold of each file before it is brought into the working space.
inline constexpr std::size_t kFileCacheBytes = std::size_t{64} << 20;

/// From a file's encoding to the working space; called from many threads.
using ToWorking = std::function<Picture(const EncodedImage&)>;

class TiledTexture {
 public:
  TiledTexture(std::shared_ptr<const TiledImage> image, ToWorking to_working,
               std::shared_ptr<TileCache> cache);

  const std::vector<TexelLevel>& levels() const { return levels_; }
  const PixelWindows& windows() const { return windows_; }
  int tile_width() const { return image_->tile_width(); }
  int tile_height() const { return image_->tile_height(); }

  std::shared_ptr<const Picture> tile(int level, int column, int row) const;

  /// Texels that were no numbers, among those that have been read.
  std::int64_t not_numbers() const { return *not_numbers_; }

 private:
  std::shared_ptr<const TiledImage> image_;
  ToWorking to_working_;
  std::shared_ptr<TileCache> cache_;
  int number_ = 0;
  std::vector<TexelLevel> levels_;
  PixelWindows windows_;
  std::shared_ptr<std::atomic<std::int64_t>> not_numbers_;
};

/// Reads a tiled texture, which has to outlive it. Holds on to the tiles that it used last.
class TiledTexels final : public Texels {
 public:
  TiledTexels(const TiledTexture& texture, Wrap wrap) : Texels(texture.levels(), wrap), texture_(texture) {}

 private:
  struct Held {
    int level = -1;
    int column = 0;
    int row = 0;
    std::shared_ptr<const Picture> tile;
  };

  TexelRun stored(int level, const TexelPlace& place) override;
  const Picture& held(int level, int column, int row);

  const TiledTexture& texture_;
  std::array<Held, 4> held_;
  std::size_t next_ = 0;
};

}  // namespace lensplane
