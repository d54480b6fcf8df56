// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/png_writer.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <fstream>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/failure.h"
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

}  // namespace

std::size_t write_png(const std::filesystem::path& path, const Picture& picture, const PngHeader& header) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec["Software"] = std::string("lensplane ") + kVersion;
  spec["Description"] = header.parameters;  // PNG carries few kinds of text; this one comes back as it was
  spec["oiio:dither"] = 1;
  if (header.srgb) spec["oiio:ColorSpace"] = "sRGB";
  const auto output = OIIO::ImageOutput::create("png");
  if (!output || !output->set_ioproxy(&memory) || !output->open(path.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, picture.pixels.data(), sizeof(Rgba)) || !output->close()) {
    throw Failure(ExitCode::BadOutput,
                  path.string() + ": cannot be written: " + (output ? output->geterror() : OIIO::geterror()));
  }
  write_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return bytes.size();
}

std::optional<std::string> read_png_parameters(const std::filesystem::path& path) {
  if (!ends_as_png(path)) return std::nullopt;
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
