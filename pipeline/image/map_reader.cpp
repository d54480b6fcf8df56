// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/map_reader.h"

#include "pipeline/image/image_library.h"

namespace lensplane {

StMap read_st_map(const std::filesystem::path& path, std::optional<StOrigin> origin) {
  return image_library().read_st_map(path, origin);
}

MapData read_map_data(const std::filesystem::path& path, const StMap& map) {
  return image_library().read_map_data(path, map);
}

std::optional<std::filesystem::path> data_file_beside(const std::filesystem::path& map) {
  std::string name = map.filename().string();
  const std::size_t part = name.rfind(".map.");
  if (part == std::string::npos) return std::nullopt;
  name.replace(part, 5, ".data.");
  const std::filesystem::path data = map.parent_path() / name;
  std::error_code error;
  if (!std::filesystem::is_regular_file(data, error)) return std::nullopt;
  return data;
}

}  // namespace lensplane
