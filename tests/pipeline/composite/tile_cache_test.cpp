// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/tile_cache.h"

#include <gtest/gtest.h>

namespace lensplane {
namespace {

Picture tile_of(int number) {
  Picture tile{8, 8, 0, 0, 8, 8, {}};
  tile.pixels.assign(64, {static_cast<float>(number), 0, 0, 1});
  return tile;
}

TEST(TileCache, MakesATileOnceWhileThereIsRoom) {
  TileCache cache(1 << 20);
  int made = 0;
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 100; ++i) {
      const auto tile = cache.tile({0, 1, i, -i}, [&] { return ++made, tile_of(i); });
      EXPECT_EQ(tile->at(3, 3)[0], i);
    }
  }
  EXPECT_EQ(made, 100);
}

TEST(TileCache, KeepsWithinItsBudgetWhatWasUsedLast) {
  constexpr std::size_t kBytes = 200000;  // about 180 tiles, 11 on each of 16 shelves
  TileCache cache(kBytes);
  int made = 0;
  const auto ask = [&](int i) { return cache.tile({0, 0, i, 0}, [&] { return ++made, tile_of(i); }); };
  const auto held = ask(0);
  for (int i = 1; i < 1000; ++i) {
    ask(i);
    EXPECT_EQ(ask(1)->at(0, 0)[0], 1);
    EXPECT_LE(cache.bytes(), kBytes);
  }
  EXPECT_EQ(made, 1000);  // 1 was never let go
  EXPECT_EQ(held->at(0, 0)[0], 0);
  ask(0);
  EXPECT_EQ(made, 1001);
}

TEST(TileCache, KeepsTexturesApart) {
  TileCache cache;
  const int a = cache.new_texture(), b = cache.new_texture();
  EXPECT_EQ(cache.tile({a, 0, 0, 0}, [] { return tile_of(1); })->at(0, 0)[0], 1);
  EXPECT_EQ(cache.tile({b, 0, 0, 0}, [] { return tile_of(2); })->at(0, 0)[0], 2);
}

}  // namespace
}  // namespace lensplane
