// SPDX-License-Identifier: Apache-2.0

#include "pipeline/oiio/pixel_layout.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "pipeline/image/failure.h"

namespace lensplane::oiio {
namespace {

// Half one, to fill the alpha of half files that have none.
constexpr std::uint16_t kHalfOne = 0x3c00;

SampleType nearest_type(OIIO::TypeDesc format) {
  if (format == OIIO::TypeDesc::UINT8) return SampleType::UInt8;
  if (format == OIIO::TypeDesc::UINT16) return SampleType::UInt16;
  if (format == OIIO::TypeDesc::HALF) return SampleType::Half;
  return SampleType::Float;
}

/// Which channels of the file are R, G, B; grey files give the same three times. Nothing when there are none
/// of these.
std::optional<std::array<int, 3>> colour_channels(const OIIO::ImageSpec& spec, std::string_view format_name) {
  const std::array<int, 3> named = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (*std::min_element(named.begin(), named.end()) >= 0) return named;
  const int grey = spec.channelindex("Y");
  if (grey >= 0) return std::array{grey, grey, grey};
  // In EXR any other name is data; elsewhere it is a format's own name for colours.
  const int without_alpha = spec.nchannels - (spec.alpha_channel >= 0 ? 1 : 0);
  if (format_name == "openexr" || without_alpha == 0) return std::nullopt;
  if (without_alpha < 3) return std::array{0, 0, 0};
  return std::array{0, 1, 2};
}

/// Channels as the file has them to RGBA; `Sample` is as large as a sample, `opaque` is full alpha.
template <class Sample>
std::vector<std::byte> rgba(const PixelLayout& layout, const std::vector<std::byte>& file, Sample opaque) {
  const std::size_t pixels = file.size() / (static_cast<std::size_t>(layout.channels) * sizeof(Sample));
  std::vector<std::byte> samples(pixels * 4 * sizeof(Sample));
  const auto* in = reinterpret_cast<const Sample*>(file.data());
  auto* out = reinterpret_cast<Sample*>(samples.data());
  for (std::size_t i = 0; i < pixels; ++i, in += layout.channels, out += 4) {
    for (std::size_t c = 0; c < 3; ++c) out[c] = in[layout.colours[c]];
    out[3] = layout.alpha >= 0 ? in[layout.alpha] : opaque;
  }
  return samples;
}

std::vector<std::byte> rgba(const PixelLayout& layout, const std::vector<std::byte>& file) {
  switch (layout.type) {
    case SampleType::UInt8:
      return rgba<std::uint8_t>(layout, file, 0xff);
    case SampleType::UInt16:
      return rgba<std::uint16_t>(layout, file, 0xffff);
    case SampleType::Half:
      return rgba<std::uint16_t>(layout, file, kHalfOne);
    case SampleType::Float:
      break;
  }
  return rgba<std::uint32_t>(layout, file, std::bit_cast<std::uint32_t>(1.0F));
}

}  // namespace

OIIO::TypeDesc oiio_type(SampleType type) {
  switch (type) {
    case SampleType::UInt8:
      return OIIO::TypeDesc::UINT8;
    case SampleType::UInt16:
      return OIIO::TypeDesc::UINT16;
    case SampleType::Half:
      return OIIO::TypeDesc::HALF;
    case SampleType::Float:
      break;
  }
  return OIIO::TypeDesc::FLOAT;
}

PixelLayout pixel_layout(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                         std::string_view format_name) {
  const auto colours = colour_channels(spec, format_name);
  if (!colours) {
    throw Failure(
        ExitCode::BadInput,
        fmt::format("{}: cannot be read as an image: it has no channels R, G, B or Y", path.string()));
  }
  return {spec.nchannels, *colours, spec.alpha_channel, nearest_type(spec.format),
          spec.get_int_attribute("oiio:UnassociatedAlpha") == 0};
}

EncodedImage packed(const PixelLayout& layout, const PixelWindows& windows,
                    const std::vector<std::byte>& file) {
  return {windows, layout.type, layout.alpha >= 0, layout.premultiplied, rgba(layout, file)};
}

PixelWindows windows_of(const OIIO::ImageSpec& spec) {
  return {spec.width,           spec.height,     spec.x - spec.full_x,
          spec.y - spec.full_y, spec.full_width, spec.full_height};
}

}  // namespace lensplane::oiio
