// SPDX-License-Identifier: Apache-2.0
//
// From a shot file to a Shot. The grammar stands in docs/shot-format.md.

#pragma once

#include <string>
#include <vector>

#include "pipeline/shot/shot.h"
#include "pipeline/shot/yaml_tree.h"

namespace lensplane {

/// Reads the shot file, with `settings` ("key.path=value") put over what it says. Of other files it
/// reads only the one that the camera is taken from. Throws
/// Failure with one line that says where, which key, what is wrong and what is allowed.
Shot read_shot(const std::filesystem::path& path, const std::vector<std::string>& settings = {});

/// The same from a tree that is already there; no file is read.
Shot shot_from_yaml(const YamlNode& root);

}  // namespace lensplane
