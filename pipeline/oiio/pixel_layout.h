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
#include "pipeline/image/image_choice.h"

// OpenImageIO's own headers take seconds to compile.
OIIO_NAMESPACE_BEGIN
class ImageInput;
class ImageSpec;
struct TypeDesc;
OIIO_NAMESPACE_END

namespace lensplane::oiio {

/// How an image file holds its samples.
struct PixelLayout {
  int first = 0;                 // of the channels that are read, among the file's
  int channels = 0;              // how many
  std::array<int, 3> colours{};  // which of them are R, G and B
  int alpha = -1;                // negative without
  SampleType type = SampleType::Float;
  bool premultiplied = true;
};

/// Throws Failure (BadInput) when the part has no colours, or no such layer.
PixelLayout pixel_layout(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                         std::string_view format_name, const ImageChoice& choice);

/// The number of the part that is chosen. Throws Failure (BadInput) when there is none.
int part_of(const std::filesystem::path& path, OIIO::ImageInput& input, const ImageChoice& choice);

/// OpenImageIO's name of the layout's type.
OIIO::TypeDesc oiio_type(SampleType type);

/// The image of samples as the file has them.
EncodedImage packed(const PixelLayout& layout, const PixelWindows& windows, const Samples& file);

/// Where the file's pixels lie.
PixelWindows windows_of(const OIIO::ImageSpec& spec);

}  // namespace lensplane::oiio
