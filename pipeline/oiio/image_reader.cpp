// SPDX-License-Identifier: Apache-2.0

#include "pipeline/oiio/image_reader.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "pipeline/image/failure.h"
#include "pipeline/image/image_reader.h"
#include "pipeline/oiio/pixel_layout.h"

namespace lensplane::oiio {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Failure(ExitCode::BadInput, fmt::format("{}: cannot be read as an image: {}", path.string(), reason));
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path) {
  std::error_code status;
  if (!std::filesystem::exists(path, status)) {
    throw Failure(ExitCode::BadInput, fmt::format("{}: no such image", path.string()));
  }
  OIIO::ImageSpec as_stored;
  as_stored["oiio:UnassociatedAlpha"] =
      1;  // else 8-bit colours would be premultiplied before they are linear
  auto input = OIIO::ImageInput::open(path.string(), &as_stored);
  if (!input) refuse(path, OIIO::geterror());
  return input;
}

}  // namespace

EncodedImage read_image(const std::filesystem::path& path, const ImageChoice& choice) {
  const auto input = open_image(path);
  const int part = part_of(path, *input, choice);
  const OIIO::ImageSpec spec = input->spec(part);
  const PixelLayout layout = pixel_layout(path, spec, input->format_name(), choice);
  if (spec.image_pixels() > kMaxImagePixels) {
    refuse(path, fmt::format("{} x {} pixels; allowed: up to {} million", spec.width, spec.height,
                             kMaxImagePixels >> 20));
  }
  Samples file(spec.image_pixels() * static_cast<std::size_t>(layout.channels) * size_of(layout.type));
  const int end = layout.first + layout.channels;
  if (!input->read_image(part, 0, layout.first, end, oiio_type(layout.type), file.data()))
    refuse(path, input->geterror());
  return packed(layout, windows_of(spec), file);
}

ImageOutline read_outline(const std::filesystem::path& path, const ImageChoice& choice) {
  const auto input = open_image(path);
  const int part = part_of(path, *input, choice);
  const OIIO::ImageSpec spec = input->spec(part);
  const PixelLayout layout = pixel_layout(path, spec, input->format_name(), choice);
  const auto name = [&](int channel) { return spec.channel_name(layout.first + channel); };
  const auto& [red, green, blue] = layout.colours;
  return {windows_of(spec),
          part,
          {name(red), name(green), name(blue)},
          layout.alpha < 0 ? "" : name(layout.alpha),
          layout.premultiplied};
}

std::string read_attribute(const std::filesystem::path& path, const char* name) {
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    OIIO::geterror();  // an unread error would be printed later
    return {};
  }
  return std::string(input->spec().get_string_attribute(name));
}

}  // namespace lensplane::oiio
