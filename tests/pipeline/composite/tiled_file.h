// SPDX-License-Identifier: Apache-2.0
//
// Tiled files with their pyramids, made for a test.

#pragma once

#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "pipeline/image/image_reader.h"
#include "pipeline/image/picture.h"

namespace lensplane {

inline OIIO::ImageBuf image_of(const Picture& picture) {
  OIIO::ImageBuf image(OIIO::ImageSpec(picture.width, picture.height, 4, OIIO::TypeDesc::FLOAT));
  image.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, picture.pixels.data());
  return image;
}

/// What `maketx` would make of an image, in float, with tiles of `tile` x `tile`.
inline void write_tiled(const std::filesystem::path& path, const OIIO::ImageBuf& image, int tile) {
  OIIO::ImageSpec configuration;
  configuration.tile_width = configuration.tile_height = tile;
  configuration.tile_depth = 1;
  configuration.set_format(OIIO::TypeDesc::FLOAT);
  ASSERT_TRUE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, path.string(),
                                               configuration))
      << OIIO::geterror();
}
inline void write_tiled(const std::filesystem::path& path, const Picture& picture, int tile) {
  write_tiled(path, image_of(picture), tile);
}

/// Float samples as they are.
inline Picture float_pixels(const EncodedImage& image) {
  Picture picture{image.width, image.height, 0, 0, image.width, image.height, {}};
  picture.pixels.resize(image.samples.size() / sizeof(Rgba));
  std::memcpy(picture.pixels.data(), image.samples.data(), image.samples.size());
  return picture;
}

}  // namespace lensplane
