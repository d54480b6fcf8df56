// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/display_writer.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <fstream>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/failure.h"
#include "pipeline/image/tiff.h"
#include "pipeline/image/version.h"

namespace lensplane {
namespace {

/// Whether the file ends with PNG's last chunk, IEND: nothing was cut off.
bool ends_as_png(const std::filesystem::path& path) {
  constexpr std::array<char, 8> kEnd = {'I', 'E', 'N', 'D', '\xae', '\x42', '\x60', '\x82'};
  std::array<char, kEnd.size()> end{};
  std::ifstream file(path, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  return file.read(end.data(), end.size()) && end == kEnd;
}

OIIO::ImageSpec png_spec(const Picture& picture, int bits, const DisplayHeader& header) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3,
                       bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
  spec["Software"] = std::string("lensplane ") + kVersion;
  spec["Description"] = header.parameters;  // PNG carries few kinds of text; this one comes back as it was
  if (!header.colour_interop.empty()) spec["colorInteropID"] = header.colour_interop;
  spec["png:compressionLevel"] = 3;  // dithered pictures are a tenth smaller at 6, and take twice as long
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

}  // namespace

bool is_tiff(const std::filesystem::path& path) {
  return path.extension() == ".tif" || path.extension() == ".tiff";
}

std::size_t write_display(const std::filesystem::path& path, const Picture& picture, int bits,
                          const DisplayHeader& header) {
  const std::vector<unsigned char> bytes = is_tiff(path) ? tiff_bytes(picture, header.parameters, header.icc)
                                                         : png_bytes(path, picture, bits, header);
  write_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return bytes.size();
}

std::optional<std::string> read_display_parameters(const std::filesystem::path& path) {
  if (!is_tiff(path) && !ends_as_png(path)) return std::nullopt;  // a TIFF ends with what is read first
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) {
    OIIO::geterror();  // an unread error would be printed later
    return std::nullopt;
  }
  const std::string parameters(input->spec().get_string_attribute("ImageDescription"));
  if (parameters.empty()) return std::nullopt;
  return parameters;
}

}  // namespace lensplane
