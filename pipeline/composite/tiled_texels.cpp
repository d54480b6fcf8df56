// SPDX-License-Identifier: Apache-2.0

#include "pipeline/composite/tiled_texels.h"

#include <tbb/task_arena.h>

#include <algorithm>

namespace lensplane {
namespace {

/// The variance of a box over `ratio` texels of the finest level, in texels of a level of such boxes.
double box_variance(double ratio) {
  return (1 - 1 / (ratio * ratio)) / 12;
}

}  // namespace

TiledTexture::TiledTexture(std::shared_ptr<const TiledImage> image, ToWorking to_working,
                           std::shared_ptr<TileCache> cache)
    : image_(std::move(image)),
      to_working_(std::move(to_working)),
      cache_(std::move(cache)),
      number_(cache_->new_texture()),
      not_numbers_(std::make_shared<std::atomic<std::int64_t>>(0)) {
  const TiledImage::Level& finest = image_->levels().front();
  windows_.width = windows_.display_width = finest.width;
  windows_.height = windows_.display_height = finest.height;
  for (const auto& [width, height] : image_->levels()) {
    levels_.push_back({{width, height, 0, 0, width, height},
                       box_variance(static_cast<double>(finest.width) / width),
                       box_variance(static_cast<double>(finest.height) / height)});
  }
}

std::shared_ptr<const Picture> TiledTexture::tile(int level, int column, int row) const {
  return cache_->tile({number_, level, column, row}, [&] {
    Picture picture;
    // Whoever waits for the conversion's parts must not begin another lookup meanwhile.
    tbb::this_task_arena::isolate([&] { picture = to_working_(image_->tile(level, column, row)); });
    *not_numbers_ += picture.not_numbers;
    return picture;
  });
}

TexelRun TiledTexels::stored(int level, const TexelPlace& place) {
  const int width = texture_.tile_width(), height = texture_.tile_height();
  const Picture& tile = held(level, place.column / width, place.row / height);
  const int column = place.column % width;
  return {&tile.at(column, place.row % height), std::min(place.count, tile.width - column)};
}

const Picture& TiledTexels::held(int level, int column, int row) {
  for (const Held& one : held_) {
    if (one.level == level && one.column == column && one.row == row) return *one.tile;
  }
  Held& oldest = held_[next_];
  next_ = (next_ + 1) % held_.size();
  oldest = {level, column, row, texture_.tile(level, column, row)};
  return *oldest.tile;
}

}  // namespace lensplane
