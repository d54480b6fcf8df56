// SPDX-License-Identifier: Apache-2.0
//
// A small shot that is right, for tests to change.

#pragma once

#include <string>
#include <vector>

#include "pipeline/shot/settings.h"
#include "pipeline/shot/shot_reader.h"

namespace lensplane {

inline const char* const kExampleShot = R"(lensplane: 1
shot: example
frames: 1001-1003
fps: 24
camera:
  resolution: [40, 20]
  fov: 3 deg
lenses:
  - name: near
    mass: 1.989e31 kg
    position: [0 m, 0 m, -4.36e8 m]
layers:
  - name: earth
    type: sphere
    centre: [0 m, 0 m, -1.09e9 m]
    radius: 6371 km
    image: earth.png
  - name: background
    type: plate
    image: bg.####.exr
trace:
  method: shinotsuka-makino
)";

/// The example with settings put over it.
inline Shot example_shot(const std::vector<std::string>& settings = {}) {
  YamlNode root = parse_yaml(kExampleShot, "example.yaml");
  for (const std::string& setting : settings) apply_setting(setting, root);
  return shot_from_yaml(root);
}

}  // namespace lensplane
