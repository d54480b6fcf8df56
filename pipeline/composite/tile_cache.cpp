// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/tile_cache.h"

#include <cstdint>

namespace lensplane {
namespace {

std::size_t size_in_bytes(const Picture& tile) {
  return sizeof tile + tile.pixels.size() * sizeof(Rgba);
}

}  // namespace

std::size_t TileCache::Hash::operator()(const TileKey& key) const {
  std::uint64_t hash = 0;
  for (const int part : {key.texture, key.level, key.column, key.row}) {
    hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15;
    hash ^= hash >> 32;
  }
  return hash;
}

std::shared_ptr<const Picture> TileCache::tile(const TileKey& key, const std::function<Picture()>& make) {
  Shelf& shelf = shelves_[Hash{}(key) % kShelves];
  const auto find = [&]() -> std::shared_ptr<const Picture> {
    const auto found = shelf.places.find(key);
    if (found == shelf.places.end()) return nullptr;
    shelf.entries.splice(shelf.entries.begin(), shelf.entries, found->second);
    return found->second->tile;
  };
  {
    const std::lock_guard lock(shelf.mutex);
    if (auto tile = find()) return tile;
  }
  auto made = std::make_shared<Picture>(make());
  const std::size_t bytes = size_in_bytes(*made);
  const std::lock_guard lock(shelf.mutex);
  if (auto tile = find()) return tile;
  UnsetVector<Rgba> spare;
  while (shelf.bytes + bytes > bytes_per_shelf_ && !shelf.entries.empty()) spare = let_oldest_go(shelf);
  if (bytes > bytes_per_shelf_) return made;
  // Memory that is kept for long is used again here, or tiles made in one thread and freed in another would
  // leave the allocator with twice the budget.
  if (spare.capacity() >= made->pixels.size()) {
    spare.assign(made->pixels.begin(), made->pixels.end());
    made->pixels.swap(spare);
  }
  shelf.entries.push_front({key, made});
  shelf.places[key] = shelf.entries.begin();
  shelf.bytes += bytes;
  return made;
}

UnsetVector<Rgba> TileCache::let_oldest_go(Shelf& shelf) {
  Entry& oldest = shelf.entries.back();
  UnsetVector<Rgba> spare;
  shelf.bytes -= size_in_bytes(*oldest.tile);
  if (oldest.tile.use_count() == 1) {
    std::atomic_thread_fence(std::memory_order_acquire);  // whoever held it has done with it
    spare.swap(oldest.tile->pixels);
  }
  shelf.places.erase(oldest.key);
  shelf.entries.pop_back();
  return spare;
}

std::size_t TileCache::bytes() const {
  std::size_t sum = 0;
  for (const Shelf& shelf : shelves_) {
    const std::lock_guard lock(shelf.mutex);
    sum += shelf.bytes;
  }
  return sum;
}

}  // namespace lensplane
