// SPDX-License-Identifier: Apache-2.0
//
// Values from the command line, put over those of a shot file: "camera.fov=2 deg".

#pragma once

#include <string>

#include "pipeline/shot/yaml_tree.h"

namespace lensplane {

/// Puts the value of "key.path=value" (YAML) into the tree. Items of lists are addressed by their `name` or
/// by their number from 0; keys of maps that are missing are made. Errors inside the value are located in
/// "--set key.path". Throws Failure (BadShot).
void apply_setting(const std::string& setting, YamlNode& root);

}  // namespace lensplane
