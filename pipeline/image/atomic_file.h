// SPDX-License-Identifier: Apache-2.0
//
// Files that appear whole or not at all.

#pragma once

#include <filesystem>
#include <span>

namespace lensplane {

/// Writes `bytes` to a temporary name beside `path`, makes sure that they are on the disk, and renames.
/// Folders that are missing are made, links are followed. Throws Failure (BadOutput) that names `path`,
/// leaving whatever stood there before; so also when that is no regular file, but a device, say.
void write_atomically(const std::filesystem::path& path, std::span<const char> bytes);

}  // namespace lensplane
