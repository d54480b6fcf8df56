// SPDX-License-Identifier: Apache-2.0

#include "pipeline/image/shipped.h"

namespace lensplane {

std::filesystem::path resolve_shipped(const std::string& path) {
  if (!path.starts_with(kShippedPrefix)) return path;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  return program.parent_path().parent_path() / "share/lensplane" / path.substr(kShippedPrefix.size());
}

}  // namespace lensplane
