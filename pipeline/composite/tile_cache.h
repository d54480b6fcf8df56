// SPDX-License-Identifier: Apache-2.0
//
// Tiles of textures in the working space, kept within a budget of memory.
//
// One cache serves any number of textures and threads. When it is full the tile that nobody has asked for the
// longest goes. Tiles in use live on while they are used, and so may exceed the budget by a few for each
// thread. Two threads that miss the same tile at once both make it; what they make is the same.

#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "pipeline/image/picture.h"

namespace lensplane {

/// What tiles may take together, unless a cache is told otherwise.
inline constexpr std::size_t kTileBytes = std::size_t{1} << 30;

struct TileKey {
  int texture = 0;  // from TileCache::new_texture
  int level = 0;
  int column = 0;  // in tiles
  int row = 0;

  bool operator==(const TileKey&) const = default;
};

class TileCache {
 public:
  explicit TileCache(std::size_t bytes = kTileBytes) : bytes_per_shelf_(bytes / kShelves) {}

  /// A number for a texture's keys.
  int new_texture() { return textures_++; }

  /// The tile of `key`; `make` is called, without any lock, when it is not there.
  std::shared_ptr<const Picture> tile(const TileKey& key, const std::function<Picture()>& make);

  /// Bytes of the tiles that are kept now.
  std::size_t bytes() const;

 private:
  // Keys are spread over shelves, so that threads seldom wait for each other.
  static constexpr std::size_t kShelves = 16;
  struct Hash {
    std::size_t operator()(const TileKey& key) const;
  };
  struct Entry {
    TileKey key;
    std::shared_ptr<Picture> tile;
  };
  struct Shelf {
    mutable std::mutex mutex;
    std::list<Entry> entries;  // the last asked for first
    std::unordered_map<TileKey, std::list<Entry>::iterator, Hash> places;
    std::size_t bytes = 0;
  };

  /// Takes a shelf's last entry away; returns its pixels' memory when nobody uses them.
  static UnsetVector<Rgba> let_oldest_go(Shelf& shelf);

  std::size_t bytes_per_shelf_;
  std::atomic<int> textures_ = 0;
  std::array<Shelf, kShelves> shelves_;
};

}  // namespace lensplane
