// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/display_writer.h"

#include <array>
#include <fstream>

#include "pipeline/image/atomic_file.h"
#include "pipeline/image/image_library.h"
#include "pipeline/image/tiff.h"

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

bool is_tiff(const std::filesystem::path& path) {
  return path.extension() == ".tif" || path.extension() == ".tiff";
}

std::size_t write_display(const std::filesystem::path& path, const Picture& picture, int bits,
                          const DisplayHeader& header) {
  const std::vector<unsigned char> bytes = is_tiff(path)
                                               ? tiff_bytes(picture, header.parameters, header.icc)
                                               : image_library().png_bytes(path, picture, bits, header);
  write_atomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return bytes.size();
}

std::optional<std::string> read_display_parameters(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  if (!is_tiff(path) && !ends_as_png(path)) return std::nullopt;  // a TIFF ends with what is read first
  const std::string parameters = image_library().read_attribute(path, "ImageDescription");
  if (parameters.empty()) return std::nullopt;
  return parameters;
}

}  // namespace lensplane
