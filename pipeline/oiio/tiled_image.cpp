// SPDX-License-Identifier: Apache-2.0

#include "pipeline/oiio/tiled_image.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/image/failure.h"
#include "pipeline/oiio/pixel_layout.h"

namespace lensplane::oiio {
namespace {

constexpr std::size_t kMostTilePixels = std::size_t{1} << 20;

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw Failure(ExitCode::BadInput, fmt::format("{}: cannot be read tile by tile: {}", path, reason));
}

std::shared_ptr<OIIO::ImageCache> make_cache(std::size_t bytes) {
  std::shared_ptr<OIIO::ImageCache> cache(OIIO::ImageCache::create(false),
                                          [](OIIO::ImageCache* kept) { OIIO::ImageCache::destroy(kept); });
  cache->attribute("max_memory_MB", static_cast<float>(bytes) / 1048576.0F);
  cache->attribute("unassociatedalpha",
                   1);  // else 8-bit colours would be premultiplied before they are linear
  return cache;
}

class CachedImage final : public TiledImage {
 public:
  CachedImage(const std::filesystem::path& path, std::size_t cache_bytes, const ImageChoice& choice);

  const std::vector<Level>& levels() const override { return levels_; }
  int tile_width() const override { return tile_width_; }
  int tile_height() const override { return tile_height_; }
  EncodedImage tile(int level, int column, int row) const override;

 private:
  std::string path_;
  std::shared_ptr<OIIO::ImageCache> cache_;
  std::vector<Level> levels_;
  int tile_width_ = 0;
  int tile_height_ = 0;
  int part_ = 0;
  PixelLayout layout_;
};

CachedImage::CachedImage(const std::filesystem::path& path, std::size_t cache_bytes,
                         const ImageChoice& choice)
    : path_(path.string()), cache_(make_cache(cache_bytes)) {
  const OIIO::ustring name(path_);
  OIIO::ImageSpec spec;
  const auto input = OIIO::ImageInput::open(path_);
  if (!input) refuse(path_, OIIO::geterror());
  part_ = part_of(path, *input, choice);
  if (!cache_->get_imagespec(name, spec, part_)) refuse(path_, cache_->geterror());
  int count = 0;
  cache_->get_image_info(name, part_, 0, OIIO::ustring("miplevels"), OIIO::TypeDesc::INT, &count);
  // A file without tiles is given as one that is a tile as a whole.
  const std::size_t tile_pixels =
      static_cast<std::size_t>(spec.tile_width) * static_cast<std::size_t>(spec.tile_height);
  if (count < 2 || tile_pixels > kMostTilePixels) {
    refuse(path_,
           fmt::format("{} x {} pixels, but not both in tiles and in smaller sizes, too; make a file that "
                       "is so: maketx {} -o FILE.tx",
                       spec.width, spec.height, path_));
  }
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height) {
    refuse(path_, "its data window is not its display window");
  }
  tile_width_ = spec.tile_width;
  tile_height_ = spec.tile_height;
  layout_ = pixel_layout(path, spec, input->format_name(), choice);
  for (int level = 0; level < count; ++level) {
    OIIO::ImageSpec coarse;
    if (!cache_->get_imagespec(name, coarse, part_, level)) refuse(path_, cache_->geterror());
    levels_.push_back({coarse.width, coarse.height});
  }
}

EncodedImage CachedImage::tile(int level, int column, int row) const {
  const Level& size = levels_[static_cast<std::size_t>(level)];
  const int left = column * tile_width_, right = std::min(left + tile_width_, size.width);
  const int top = row * tile_height_, bottom = std::min(top + tile_height_, size.height);
  const int width = right - left, height = bottom - top;
  Samples file(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
               static_cast<std::size_t>(layout_.channels) * size_of(layout_.type));
  const OIIO::ustring name(path_);
  if (!cache_->get_pixels(name, part_, level, left, right, top, bottom, 0, 1, layout_.first,
                          layout_.first + layout_.channels, oiio_type(layout_.type), file.data())) {
    refuse(path_, cache_->geterror());
  }
  return packed(layout_, {width, height, 0, 0, width, height}, file);
}

}  // namespace

bool is_larger_than_memory(const std::filesystem::path& path, const ImageChoice& choice) {
  std::error_code status;
  if (!std::filesystem::exists(path, status)) {
    throw Failure(ExitCode::BadInput, fmt::format("{}: no such image", path.string()));
  }
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    throw Failure(ExitCode::BadInput,
                  fmt::format("{}: cannot be read as an image: {}", path.string(), OIIO::geterror()));
  }
  return input->spec(part_of(path, *input, choice)).image_pixels() > kMostPixelsInMemory;
}

std::shared_ptr<const TiledImage> open_tiled_image(const std::filesystem::path& path, std::size_t cache_bytes,
                                                   const ImageChoice& choice) {
  return std::make_shared<CachedImage>(path, cache_bytes, choice);
}

}  // namespace lensplane::oiio
