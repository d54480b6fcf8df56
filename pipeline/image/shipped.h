// SPDX-License-Identifier: Apache-2.0
//
// Files that are shipped with lensplane: `lensplane:textures/earth_day.jpg` in a shot.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lensplane {

inline constexpr std::string_view kShippedPrefix = "lensplane:";

/// Where the program is installed: the folder that holds its own, bin.
std::filesystem::path installation_folder();

/// The path of a file: as it stands, or in the folder share/lensplane beside the program's own when it starts
/// with kShippedPrefix.
std::filesystem::path resolve_shipped(const std::string& path);

}  // namespace lensplane
