// SPDX-License-Identifier: Apache-2.0

#include "pipeline/oiio/png_writer.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "pipeline/image/failure.h"
#include "pipeline/image/version.h"

namespace lensplane::oiio {
namespace {

constexpr int kPaeth = 0x80;  // libpng's number of that filter

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
  if (bits == 8) spec["oiio:dither"] = 1;
  // PNG has a word of its own for sRGB, which excludes a profile.
  if (header.colour_interop.starts_with("srgb_rec709_")) {
    spec["oiio:ColorSpace"] = "sRGB";
  } else if (!header.icc.empty()) {
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(header.icc.size())),
                   header.icc.data());
  }
  return spec;
}

}  // namespace

std::vector<unsigned char> png_bytes(const std::filesystem::path& path, const Picture& picture, int bits,
                                     const DisplayHeader& header) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create("png");
  if (!output || !output->set_ioproxy(&memory) ||
      !output->open(path.string(), png_spec(picture, bits, header)) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, picture.pixels.data(), sizeof(Rgba)) || !output->close()) {
    throw Failure(ExitCode::BadOutput,
                  path.string() + ": cannot be written: " + (output ? output->geterror() : OIIO::geterror()));
  }
  return bytes;
}

}  // namespace lensplane::oiio
