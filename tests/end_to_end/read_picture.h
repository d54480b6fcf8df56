// SPDX-License-Identifier: Apache-2.0
//
// Images that the program has written, read by OpenImageIO.

#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagecache.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace lensplane {

/// All pixels as floats. OpenImageIO remembers the headers of files that it has read; what was written twice
/// within a second it would take for the same, and so is made to forget.
inline OIIO::ImageBuf read_picture(const std::filesystem::path& path) {
  OIIO::ImageCache::create()->invalidate(OIIO::ustring(path.string()), true);
  OIIO::ImageBuf image(path.string());
  EXPECT_TRUE(image.read(0, 0, true, OIIO::TypeDesc::FLOAT)) << path;
  return image;
}

}  // namespace lensplane
