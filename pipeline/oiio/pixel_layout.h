// SPDX-License-Identifier: Apache-2.0
//
// How image files hold their pixels, as OpenImageIO tells it.

#pragma once

#include <OpenImageIO/oiioversion.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

#include "pipeline/image/encoded_image.h"

// OpenImageIO's own headers take seconds to compile.
OIIO_NAMESPACE_BEGIN
class ImageSpec;
struct TypeDesc;
OIIO_NAMESPACE_END

namespace lensplane::oiio {

/// How an image file holds its samples.
struct PixelLayout {
  int channels = 0;
  std::array<int, 3> colours{};  // which of them are R, G and B
  int alpha = -1;                // negative without
  SampleType type = SampleType::Float;
  bool premultiplied = true;
};

/// Throws Failure (BadInput) when the file has no colours.
PixelLayout pixel_layout(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                         std::string_view format_name);

/// OpenImageIO's name of the layout's type.
OIIO::TypeDesc oiio_type(SampleType type);

/// The image of samples as the file has them.
EncodedImage packed(const PixelLayout& layout, const PixelWindows& windows,
                    const std::vector<std::byte>& file);

/// Where the file's pixels lie.
PixelWindows windows_of(const OIIO::ImageSpec& spec);

}  // namespace lensplane::oiio
