// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/tiff.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "pipeline/image/version.h"

namespace lensplane {
namespace {

enum FieldType : std::uint16_t { kAscii = 2, kShort = 3, kLong = 4, kUndefined = 7 };

/// A TIFF in the making, little-endian.
class TiffBytes {
 public:
  TiffBytes& u16(std::uint32_t value) {
    bytes.push_back(static_cast<unsigned char>(value));
    bytes.push_back(static_cast<unsigned char>(value >> 8));
    return *this;
  }
  TiffBytes& u32(std::uint32_t value) { return u16(value & 0xffff).u16(value >> 16); }

  /// Puts values that do not fit into a field where the file ends now; their place.
  template <class Range>
  std::uint32_t append(const Range& values) {
    if (bytes.size() % 2 != 0) bytes.push_back(0);
    const auto place = static_cast<std::uint32_t>(bytes.size());
    bytes.insert(bytes.end(), std::begin(values), std::end(values));
    return place;
  }

  std::vector<unsigned char> bytes;
};

struct Field {
  std::uint16_t tag;
  FieldType type;
  std::uint32_t count;
  std::uint32_t value;  // or its place
};

std::uint16_t code_of(float value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 65535.0F));
}

void append_pixels(const Picture& picture, TiffBytes& file) {
  file.bytes.reserve(file.bytes.size() + 6 * picture.pixels.size() + 4096);
  for (const Rgba& pixel : picture.pixels) {
    for (std::size_t c = 0; c < 3; ++c) file.u16(code_of(pixel[c]));
  }
}

Field text_field(std::uint16_t tag, const std::string& text, TiffBytes& file) {
  const std::string with_end = text + std::string(4, '\0');  // so long that it never fits into the field
  return {tag, kAscii, static_cast<std::uint32_t>(with_end.size()), file.append(with_end)};
}

}  // namespace

std::vector<unsigned char> tiff_bytes(const Picture& picture, const std::string& description,
                                      const std::vector<unsigned char>& icc) {
  TiffBytes file;
  file.u16(0x4949).u16(42).u32(0);
  const auto pixels = static_cast<std::uint32_t>(file.bytes.size());
  append_pixels(picture, file);
  const auto pixel_bytes = static_cast<std::uint32_t>(file.bytes.size()) - pixels;
  const std::array<unsigned char, 6> bits = {16, 0, 16, 0, 16, 0};
  std::vector<Field> fields = {{256, kLong, 1, static_cast<std::uint32_t>(picture.width)},
                               {257, kLong, 1, static_cast<std::uint32_t>(picture.height)},
                               {258, kShort, 3, file.append(bits)},
                               {259, kShort, 1, 1},   // no compression
                               {262, kShort, 1, 2}};  // RGB
  if (!description.empty()) fields.push_back(text_field(270, description, file));
  fields.push_back({273, kLong, 1, pixels});
  fields.push_back({277, kShort, 1, 3});
  fields.push_back({278, kLong, 1, static_cast<std::uint32_t>(picture.height)});
  fields.push_back({279, kLong, 1, pixel_bytes});
  fields.push_back({284, kShort, 1, 1});  // R, G, B of a pixel beside one another
  fields.push_back(text_field(305, std::string("lensplane ") + kVersion, file));
  if (!icc.empty())
    fields.push_back({34675, kUndefined, static_cast<std::uint32_t>(icc.size()), file.append(icc)});

  const std::uint32_t directory = file.append(std::string());
  file.u16(static_cast<std::uint32_t>(fields.size()));
  for (const Field& field : fields) file.u16(field.tag).u16(field.type).u32(field.count).u32(field.value);
  file.u32(0);
  for (std::size_t i = 0; i < 4; ++i) file.bytes[4 + i] = static_cast<unsigned char>(directory >> (8 * i));
  return file.bytes;
}

}  // namespace lensplane
