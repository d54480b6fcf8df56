// SPDX-License-Identifier: Apache-2.0
//
// Image files as they are on disk: values as stored, colour not yet interpreted.

#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lensplane {

/// Larger images are refused: they would not fit into memory as they are worked with.
inline constexpr std::size_t kMaxImagePixels = std::size_t{1} << 29;

enum class SampleType { UInt8, UInt16, Half, Float };

/// Size of one sample in bytes.
constexpr std::size_t size_of(SampleType type) {
  return type == SampleType::UInt8 ? 1 : type == SampleType::Float ? 4 : 2;
}

/// RGBA samples row by row from the top, in the file's own type and encoding. Grey files have R = G = B,
/// files without alpha have it at full. The data window lies in the display window as Picture says.
struct EncodedImage {
  int width = 0;
  int height = 0;
  int x = 0;
  int y = 0;
  int display_width = 0;
  int display_height = 0;
  SampleType type = SampleType::Float;
  bool has_alpha = false;
  bool premultiplied = true;  // whether colours are premultiplied by alpha; true without alpha
  std::vector<std::byte> samples;
};

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

/// Fills `image.samples`, and what else the layout says, from samples as the file has them.
void pack(const PixelLayout& layout, const std::vector<std::byte>& file, EncodedImage& image);

/// Reads the first part of an image. EXR and whatever else OpenImageIO reads. Throws Failure (BadInput) with
/// the path and the reason.
EncodedImage read_image(const std::filesystem::path& path);

/// The colorInteropID that an image says about itself, read from its header alone; empty when it says none,
/// or cannot be read.
std::string read_interop_id(const std::filesystem::path& path);

}  // namespace lensplane
