// SPDX-License-Identifier: Apache-2.0

#include "pipeline/oiio/pixel_layout.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason) {
  throw Failure(ExitCode::BadInput, fmt::format("{}: cannot be read as an image: {}", path.string(), reason));
}

/// The channel that is called `name` (one capital letter) in a layer, or in none; negative without.
int channel_of(const OIIO::ImageSpec& spec, const std::string& layer, char name) {
  const std::string before = layer.empty() ? "" : layer + ".";
  const int capital = spec.channelindex(before + name);
  if (capital >= 0 || layer.empty()) return capital;
  return spec.channelindex(before + static_cast<char>(name - 'A' + 'a'));
}

std::vector<std::string> layers_of(const OIIO::ImageSpec& spec) {
  std::vector<std::string> layers;
  for (const std::string& channel : spec.channelnames) {
    const std::size_t dot = channel.rfind('.');
    if (dot == std::string::npos) continue;
    const std::string layer = channel.substr(0, dot);
    if (std::find(layers.begin(), layers.end(), layer) == layers.end()) layers.push_back(layer);
  }
  return layers;
}

/// Which channels of the file are R, G, B; grey files give the same three times. Nothing when there are none
/// of these.
std::optional<std::array<int, 3>> colour_channels(const OIIO::ImageSpec& spec, std::string_view format_name,
                                                  const std::string& layer) {
  const std::array<int, 3> named = {channel_of(spec, layer, 'R'), channel_of(spec, layer, 'G'),
                                    channel_of(spec, layer, 'B')};
  if (*std::min_element(named.begin(), named.end()) >= 0) return named;
  const int grey = channel_of(spec, layer, 'Y');
  if (grey >= 0) return std::array{grey, grey, grey};
  // In EXR any other name is data; elsewhere it is a format's own name for colours.
  const int without_alpha = spec.nchannels - (spec.alpha_channel >= 0 ? 1 : 0);
  if (!layer.empty() || format_name == "openexr" || without_alpha == 0) return std::nullopt;
  if (without_alpha < 3) return std::array{0, 0, 0};
  return std::array{0, 1, 2};
}

/// "; its layers: a, b", or nothing without any.
std::string told_layers(const OIIO::ImageSpec& spec) {
  const std::vector<std::string> layers = layers_of(spec);
  return layers.empty() ? "" : fmt::format("; its layers: {}", fmt::join(layers, ", "));
}

std::string name_of(const OIIO::ImageSpec& part) {
  return std::string(part.get_string_attribute("oiio:subimagename", part.get_string_attribute("name")));
}

/// Channels as the file has them to RGBA; `Sample` is as large as a sample, `opaque` is full alpha.
template <class Sample>
Samples rgba(const PixelLayout& layout, const Samples& file, Sample opaque) {
  const std::size_t pixels = file.size() / (static_cast<std::size_t>(layout.channels) * sizeof(Sample));
  Samples samples(pixels * 4 * sizeof(Sample));
  constexpr std::size_t kGrain = 1 << 14;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, kGrain), [&](const auto& range) {
    const auto first = static_cast<std::ptrdiff_t>(range.begin());
    const auto* in = reinterpret_cast<const Sample*>(file.data()) + first * layout.channels;
    auto* out = reinterpret_cast<Sample*>(samples.data()) + first * 4;
    for (std::size_t i = range.begin(); i != range.end(); ++i, in += layout.channels, out += 4) {
      for (std::size_t c = 0; c < 3; ++c) out[c] = in[layout.colours[c]];
      out[3] = layout.alpha >= 0 ? in[layout.alpha] : opaque;
    }
  });
  return samples;
}

Samples rgba(const PixelLayout& layout, const Samples& file) {
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
                         std::string_view format_name, const ImageChoice& choice) {
  const auto colours = colour_channels(spec, format_name, choice.layer);
  if (!colours && choice.layer.empty()) refuse(path, "it has no channels R, G, B or Y" + told_layers(spec));
  if (!colours) {
    const std::string told = told_layers(spec);
    refuse(path, fmt::format("it has no layer \"{}\" with R, G, B or Y{}", choice.layer,
                             told.empty() ? "; it has no layers" : told));
  }
  const int own_alpha = choice.layer.empty() ? -1 : channel_of(spec, choice.layer, 'A');
  // OpenImageIO takes any layer's alpha of an EXR for the file's.
  const int of_part = format_name == "openexr" ? spec.channelindex("A") : spec.alpha_channel;
  const int alpha = own_alpha >= 0 ? own_alpha : of_part;
  const auto [least, most] = std::minmax_element(colours->begin(), colours->end());
  const int first = alpha >= 0 ? std::min(*least, alpha) : *least, last = std::max(*most, alpha);
  return {first,
          last - first + 1,
          {(*colours)[0] - first, (*colours)[1] - first, (*colours)[2] - first},
          alpha >= 0 ? alpha - first : -1,
          nearest_type(spec.format),
          spec.get_int_attribute("oiio:UnassociatedAlpha") == 0};
}

int part_of(const std::filesystem::path& path, OIIO::ImageInput& input, const ImageChoice& choice) {
  if (choice.part.empty()) return 0;
  std::vector<std::string> names;
  for (int part = 0; input.seek_subimage(part, 0); ++part) {
    names.push_back(name_of(input.spec()));
    if (names.back() == choice.part || std::to_string(part) == choice.part) return part;
    if (names.back().empty()) names.back() = std::to_string(part);
  }
  input.geterror();  // of the part after the last
  refuse(path, fmt::format("it has no part \"{}\"; its parts: {}", choice.part, fmt::join(names, ", ")));
}

EncodedImage packed(const PixelLayout& layout, const PixelWindows& windows, const Samples& file) {
  return {windows, layout.type, layout.alpha >= 0, layout.premultiplied, rgba(layout, file)};
}

PixelWindows windows_of(const OIIO::ImageSpec& spec) {
  return {spec.width,           spec.height,     spec.x - spec.full_x,
          spec.y - spec.full_y, spec.full_width, spec.full_height};
}

}  // namespace lensplane::oiio
