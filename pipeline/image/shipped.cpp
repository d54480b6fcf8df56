// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/shipped.h"

namespace lensplane {

std::filesystem::path installation_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
}

std::filesystem::path resolve_shipped(const std::string& path) {
  if (!path.starts_with(kShippedPrefix)) return path;
  return installation_folder() / "share/lensplane" / path.substr(kShippedPrefix.size());
}

}  // namespace lensplane
