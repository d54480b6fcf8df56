// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/image_reader.h"

#include "pipeline/image/image_library.h"

namespace lensplane {

EncodedImage read_image(const std::filesystem::path& path, const ImageChoice& choice) {
  return image_library().read_image(path, choice);
}

ImageOutline read_outline(const std::filesystem::path& path, const ImageChoice& choice) {
  return image_library().read_outline(path, choice);
}

std::string read_interop_id(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension == ".jpg" || extension == ".jpeg") return {};  // JPEG has no place for it
  return image_library().read_attribute(path, "colorInteropID");
}

}  // namespace lensplane
