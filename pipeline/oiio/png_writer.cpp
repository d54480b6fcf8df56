// SPDX-License-Identifier: Apache-2.0

#include "pipeline/oiio/png_writer.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstdint>

#include "pipeline/image/failure.h"
#include "pipeline/image/version.h"

namespace lensplane::oiio {
namespace {

constexpr int kPaeth = 0x80;              // libpng's number of that filter
constexpr float kDither = 1.0F / 255.0F;  // as far as OpenImageIO's own dithering goes

OIIO::ImageSpec png_spec(const Picture& picture, int bits, const DisplayHeader& header) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3,
                       bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
  spec["Software"] = std::string("lensplane ") + kVersion;
  spec["Description"] = header.parameters;  // PNG carries few kinds of text; this one comes back as it was
  if (!header.colour_interop.empty()) spec["colorInteropID"] = header.colour_interop;
  // In dithered pictures there is little to find but runs: so they are as small as at zlib's level 3 with all
  // filters, in three quarters of the time.
  spec["compression"] = "rle";
  spec["png:filter"] = kPaeth;
  // PNG has a word of its own for sRGB, which excludes a profile.
  if (header.colour_interop.starts_with("srgb_rec709_")) {
    spec["oiio:ColorSpace"] = "sRGB";
  } else if (!header.icc.empty()) {
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(header.icc.size())),
                   header.icc.data());
  }
  return spec;
}

/// RGB in 8 bits, dithered, or 16; as OpenImageIO would do it on one thread.
template <class Code>
std::vector<Code> codes_of(const Picture& picture, OIIO::TypeDesc type) {
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<Code> codes(picture.pixels.size() * 3);
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.height, 16), [&](const auto& rows) {
    std::vector<float> row(width * 3);
    for (int y = rows.begin(); y != rows.end(); ++y) {
      const std::size_t first = static_cast<std::size_t>(y) * width;
      for (std::size_t i = 0; i < width; ++i) {
        for (std::size_t c = 0; c < 3; ++c) row[3 * i + c] = picture.pixels[first + i][c];
      }
      if (sizeof(Code) == 1) {
        OIIO::add_dither(3, picture.width, 1, 1, row.data(), OIIO::AutoStride, OIIO::AutoStride,
                         OIIO::AutoStride, kDither, -1, -1, 1, 0, 0, y, 0);
      }
      OIIO::convert_pixel_values(OIIO::TypeDesc::FLOAT, row.data(), type, &codes[3 * first],
                                 static_cast<int>(row.size()));
    }
  });
  return codes;
}

}  // namespace

std::vector<unsigned char> png_bytes(const std::filesystem::path& path, const Picture& picture, int bits,
                                     const DisplayHeader& header) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto write = [&](OIIO::ImageOutput& output) {
    if (bits == 16)
      return output.write_image(OIIO::TypeDesc::UINT16,
                                codes_of<std::uint16_t>(picture, OIIO::TypeDesc::UINT16).data());
    return output.write_image(OIIO::TypeDesc::UINT8,
                              codes_of<std::uint8_t>(picture, OIIO::TypeDesc::UINT8).data());
  };
  const auto output = OIIO::ImageOutput::create("png");
  if (!output || !output->set_ioproxy(&memory) ||
      !output->open(path.string(), png_spec(picture, bits, header)) || !write(*output) || !output->close()) {
    throw Failure(ExitCode::BadOutput,
                  path.string() + ": cannot be written: " + (output ? output->geterror() : OIIO::geterror()));
  }
  return bytes;
}

}  // namespace lensplane::oiio
